#include "arboc/page/page.hpp"

#include <stdexcept>

namespace arboc {
namespace page {

/// Made by the build (embed.cmake).
const std::map<std::string, std::string>& embedded_files();

namespace {

const std::string& embedded(const std::string& name) {
  const auto file = embedded_files().find(name);
  if (file == embedded_files().end()) throw std::logic_error("no embedded file " + name);
  return file->second;
}

/// JSON inside a <script> element: `<` occurs in strings only.
std::string in_script(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

/// A JSON string.
std::string quoted(const std::string& text) {
  static const char* const kHex = "0123456789abcdef";
  std::string out = "\"";
  out.reserve(text.size() + text.size() / 16);
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (out += '\\') += c;
    else if (c == '\n')
      out += "\\n";
    else if (static_cast<unsigned char>(c) < 0x20)
      ((out += "\\u00") += kHex[(c >> 4) & 15]) += kHex[c & 15];
    else
      out += c;
  }
  return out + '"';
}

/// `{"name": value, ...}` of texts that are JSON already.
std::string object(const std::map<std::string, std::string>& members) {
  std::string out = "{";
  for (const auto& member : members)
    out += (out.size() > 1 ? ",\n" : "\n") + quoted(member.first) + ": " + member.second;
  return out + "}";
}

}  // namespace

std::string write(const Page& page) {
  std::map<std::string, std::string> modules;
  for (const auto& module : {std::pair<const char*, const char*>{"three", "three.module.min.js"},
                             {"three/addons/controls/OrbitControls.js", "OrbitControls.js"},
                             {"arboc/skeleton", "skeleton.js"},
                             {"arboc/animation", "animation.js"}})
    modules[module.first] = quoted(embedded(module.second));
  for (const auto& module : page.modules) modules[module.first] = quoted(module.second);
  const std::string contents = object(
      {{"modules", object(modules)}, {"data", object(page.data)}, {"main", quoted(page.main)}});
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         html(page.title) + "</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n" +
         embedded("page.css") + page.style + "</style>\n</head>\n<body>\n" + page.body +
         "<noscript><p>This page needs JavaScript.</p></noscript>\n"
         "<script type=\"application/json\" id=\"arboc-page\">" +
         in_script(contents) + "</script>\n<script>\n" + embedded("loader.js") +
         "</script>\n</body>\n</html>\n";
}

std::string animation(const std::string& title, const std::string& motion) {
  Page page;
  page.title = title;
  page.body = embedded("animation.html");
  page.main = "arboc/animation";
  page.data["motion"] = motion;
  return write(page);
}

}  // namespace page
}  // namespace arboc

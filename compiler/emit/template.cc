#include "emit/template.h"

#include <fmt/format.h>

#include <set>
#include <stdexcept>

namespace arboc {

/// Made by the build (embed.cmake).
const std::map<std::string, std::string>& embedded_files();

const std::string& embedded(const std::string& name) {
  const auto file = embedded_files().find(name);
  if (file == embedded_files().end()) throw std::logic_error("no embedded file " + name);
  return file->second;
}

std::vector<std::string> embedded_names(const std::string& prefix) {
  std::vector<std::string> names;
  for (const auto& [name, text] : embedded_files())
    if (name.starts_with(prefix)) names.push_back(name);
  return names;
}

std::string fill(const std::string& name, const std::map<std::string, std::string>& values) {
  const std::string& text = embedded(name);
  std::string out;
  std::set<std::string> used;
  size_t at = 0;
  for (size_t open; (open = text.find('@', at)) != std::string::npos;) {
    const size_t close = text.find('@', open + 1);
    if (close == std::string::npos)
      throw std::logic_error(fmt::format("template {}: single @", name));
    const std::string key = text.substr(open + 1, close - open - 1);
    const auto value = values.find(key);
    if (value == values.end())
      throw std::logic_error(fmt::format("template {}: no value for @{}@", name, key));
    out += text.substr(at, open - at) + value->second;
    used.insert(key);
    at = close + 1;
  }
  for (const auto& [key, value] : values)
    if (!used.contains(key))
      throw std::logic_error(fmt::format("template {}: @{}@ is not used", name, key));
  return out + text.substr(at);
}

}  // namespace arboc

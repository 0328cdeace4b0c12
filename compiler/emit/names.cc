#include "emit/names.h"

#include <fmt/format.h>

#include <iterator>
#include <set>
#include <sstream>

#include "emit/template.h"

namespace arboc {
namespace {

bool letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool digit(char c) { return c >= '0' && c <= '9'; }

/// Words that cannot be the name of a namespace: keywords of C and C++, and what the headers of the
/// C and C++ libraries, of Eigen and of generated code define as macros or declare.  A test
/// enumerates the words of those headers (differential/emitted_names_test).
const std::set<std::string, std::less<>>& reserved_words() {
  static const std::set<std::string, std::less<>> words = [] {
    std::istringstream text(embedded("names/reserved_words.txt"));
    return std::set<std::string, std::less<>>(std::istream_iterator<std::string>(text), {});
  }();
  return words;
}

bool reserved(std::string_view name) {
  return name.starts_with("EIGEN_") || name.starts_with("ARBOC_") ||
         reserved_words().contains(name);
}

}  // namespace

std::string identifier(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const char next = letter(c) || digit(c) ? c : '_';
    if (next == '_' && (out.empty() || out.back() == '_')) continue;
    out += next;
  }
  if (out.size() > 64) out.resize(64);
  while (!out.empty() && out.back() == '_') out.pop_back();
  if (out.empty()) return "model";
  if (digit(out.front())) out.insert(0, "m");
  if (reserved(out)) out += "_model";
  return out;
}

std::string upper_case(std::string_view text) {
  std::string out;
  for (const char c : text) out += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return out;
}

std::string comment_text(std::string_view text) {
  constexpr std::string_view kSafe = " _.,:+-'()[]=";
  std::string out;
  for (const char c : text)
    out += letter(c) || digit(c) || kSafe.find(c) != std::string_view::npos ? c : '_';
  return out;
}

std::string string_literal(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += std::string("\\") + c;
    else if (c < 0x20 || c > 0x7E || c == '?')
      out += fmt::format("\\{:03o}", static_cast<unsigned char>(c));
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace arboc

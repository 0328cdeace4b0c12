#include "frontend/dh_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace arboc {
namespace {

Location place(const toml::source_position& at) {
  return {static_cast<int>(at.line), static_cast<int>(at.column)};
}

bool before(Location a, Location b) {
  return a.line != b.line ? a.line < b.line : a.column < b.column;
}

class Converter {
 public:
  explicit Converter(std::string_view text) : text_(text) {
    line_start_.push_back(0);
    for (size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') line_start_.push_back(i + 1);
  }

  DhValue value(const toml::node& node) const {
    using Kind = DhValue::Kind;
    DhValue out;
    out.where = place(node.source().begin);
    if (const auto* table = node.as_table()) return this->table(*table);
    if (const auto* list = node.as_array()) {
      out.kind = Kind::kList;
      for (const toml::node& item : *list) out.items.push_back(value(item));
    } else if (const auto* text = node.as_string()) {
      out.kind = Kind::kText;
      out.text = text->get();
    } else if (node.is_number()) {
      out.kind = Kind::kNumber;
      out.number = node.value<double>().value_or(0);
      out.text = spelt(node.source());
    } else {
      out.text = spelt(node.source());
      if (const auto* flag = node.as_boolean()) {
        out.kind = Kind::kFlag;
        out.flag = flag->get();
      }
    }
    return out;
  }

  DhValue table(const toml::table& table) const {
    DhValue out;
    out.kind = DhValue::Kind::kTable;
    out.where = place(table.source().begin);
    for (const auto& [key, node] : table)
      out.entries.push_back({std::string(key.str()), place(key.source().begin), value(node)});
    std::sort(
        out.entries.begin(), out.entries.end(),
        [](const DhValue::Entry& a, const DhValue::Entry& b) { return before(a.where, b.where); });
    return out;
  }

 private:
  /// The text of a plain value, which has no blanks; toml++ counts characters, so it is the text
  /// itself only where what stands before it in the line is ASCII.
  std::string spelt(const toml::source_region& region) const {
    if (region.begin.line == 0 || region.begin.line > line_start_.size()) return "";
    const size_t begin = line_start_[region.begin.line - 1] + region.begin.column - 1;
    if (begin >= text_.size()) return "";
    const size_t end = std::min(text_.find_first_of(" \t\r\n,]}#", begin), text_.size());
    return std::string(text_.substr(begin, end - begin));
  }

  std::string_view text_;
  std::vector<size_t> line_start_;
};

std::string hint_for(std::string_view text, Location where) {
  size_t begin = 0;
  for (int line = 1; line < where.line && begin != std::string_view::npos; ++line)
    begin = text.find('\n', begin) == std::string_view::npos ? begin : text.find('\n', begin) + 1;
  const std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
  if (line.find("\xE2\x88\x92") != std::string_view::npos)
    return "the minus sign is U+2212; write '-'";
  return fmt::format("line {} is {}", where.line, quoted(line));
}

/// What the file looks like, if not like TOML.
const char* other_format(std::string_view text) {
  const size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return "the file is empty";
  if (text[first] == '<') return "the file looks like URDF or other XML, not like a DH table";
  if (text[first] == '{') return "the file looks like JSON, not like a DH table";
  return nullptr;
}

}  // namespace

const char* DhValue::kind_name() const {
  switch (kind) {
    case Kind::kText: return "text";
    case Kind::kNumber: return "a number";
    case Kind::kFlag: return "true or false";
    case Kind::kList: return "a list";
    case Kind::kTable: return "a table";
    case Kind::kOther: return "a date or time";
  }
  return "";
}

std::optional<DhValue> read_toml(std::string_view text, Findings& findings) {
  const auto refuse = [&](Location where, std::string message, std::string hint) {
    findings.error({where, "", std::move(message), std::move(hint)});
    return std::nullopt;
  };
  if (text.size() > kMaxDhBytes)
    return refuse({}, "the file is too large for a DH table",
                  fmt::format("the limit is {} MiB", kMaxDhBytes >> 20));
  if (const char* message = other_format(text))
    return refuse({1, 1}, message, "a DH table is TOML, see docs/dh.md");
  try {
    const toml::table document = toml::parse(text);
    return Converter(text).table(document);
  } catch (const toml::parse_error& e) {
    const Location where = place(e.source().begin);
    return refuse(where, fmt::format("not well-formed TOML: {}", e.description()),
                  hint_for(text, where));
  }
}

}  // namespace arboc

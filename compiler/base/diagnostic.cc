#include "base/diagnostic.h"

#include <fmt/format.h>

#include <utility>

namespace arboc {

const char* name(Severity severity) {
  switch (severity) {
    case Severity::kNote: return "note";
    case Severity::kWarning: return "warning";
    case Severity::kError: return "error";
  }
  return "error";
}

namespace {

/// Length of the valid UTF-8 sequence at the start of `text`, 0 if there is none.
size_t utf8_length(std::string_view text) {
  const auto byte = [&](size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(0);
  const size_t length = first < 0x80                    ? 1
                        : first >= 0xC2 && first < 0xE0 ? 2
                        : first >= 0xE0 && first < 0xF0 ? 3
                        : first >= 0xF0 && first < 0xF5 ? 4
                                                        : 0;
  for (size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  if ((first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) > 0x9F)) return 0;
  if ((first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) > 0x8F)) return 0;
  return length;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto first = static_cast<unsigned char>(text[0]);
    const size_t length = utf8_length(text);
    const bool c1_control =
        first == 0xC2 && length == 2 && static_cast<unsigned char>(text[1]) < 0xA0;
    if (length == 0 || first < 0x20 || first == 0x7F || c1_control) {
      out += fmt::format("\\x{:02x}", first);
      text.remove_prefix(1);
    } else {
      out += text.substr(0, length);
      text.remove_prefix(length);
    }
  }
  return out;
}

std::string to_string(const Diagnostic& d) {
  std::string out;
  if (!d.file.empty()) out += printable(d.file) + ":";
  if (d.location.line > 0) out += fmt::format("{}:{}:", d.location.line, d.location.column);
  if (!out.empty()) out += " ";
  out += fmt::format("{}: ", name(d.severity));
  if (!d.element.empty()) out += printable(d.element) + ": ";
  out += printable(d.message);
  if (!d.hint.empty()) out += " (" + printable(d.hint) + ")";
  return out;
}

void Diagnostics::report(Diagnostic diagnostic) {
  errors_ += diagnostic.severity == Severity::kError;
  warnings_ += diagnostic.severity == Severity::kWarning;
  all_.push_back(std::move(diagnostic));
}

void Diagnostics::promote_warnings() {
  for (Diagnostic& d : all_)
    if (d.severity == Severity::kWarning) d.severity = Severity::kError;
  errors_ += warnings_;
  warnings_ = 0;
}

}  // namespace arboc

#include "frontend/values.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/number.h"
#include "model/findings.h"

namespace arboc {
namespace {

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

/// What to do about text that is not a number.
std::string remedy(std::string_view text) {
  const std::string word = lower_case(text);
  const auto has = [&](std::string_view part) { return word.find(part) != std::string::npos; };
  if (has("${") || has("$(")) return "expand the file with xacro first";
  if (has("inf") || has("nan")) return "every number must be finite";
  if (has("0x")) return "write it in decimal";
  if (has(",")) return "separate numbers by blanks and write a decimal point";
  if (has("pi")) return "write the number itself";
  if (has("\xE2\x88\x92")) return "the minus sign is U+2212; write '-'";
  return "";
}

/// Removes leading digits; how many there were.
size_t skip_digits(std::string_view& text) {
  const size_t count = std::min(text.find_first_not_of("0123456789"), text.size());
  text.remove_prefix(count);
  return count;
}

void skip_sign(std::string_view& text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
}

/// Whether text that is not a double is a number all the same.
bool is_out_of_range(std::string_view text) {
  skip_sign(text);
  size_t digits = skip_digits(text);
  if (text.starts_with('.')) {
    text.remove_prefix(1);
    digits += skip_digits(text);
  }
  if (digits == 0) return false;
  if (text.empty()) return true;
  if (text[0] != 'e' && text[0] != 'E') return false;
  text.remove_prefix(1);
  skip_sign(text);
  return skip_digits(text) > 0 && text.empty();
}

}  // namespace

Numbers parse_numbers(std::string_view text, Value kind) {
  constexpr std::string_view kBlanks = " \t\r\n";
  constexpr size_t kCounted = 100;
  Numbers result;
  size_t count = 0;
  for (size_t i = text.find_first_not_of(kBlanks);
       i != std::string_view::npos && count <= kCounted;) {
    const size_t end = std::min(text.find_first_of(kBlanks, i), text.size());
    const std::string_view word = text.substr(i, end - i);
    const auto number = parse_finite(word);
    if (!number) {
      const bool range = is_out_of_range(word);
      result.fault = fmt::format("{} is {}", quoted(word),
                                 range ? "beyond the range of double" : "not a number");
      result.hint = range ? "" : remedy(word);
      return result;
    }
    if (count < numbers_in(kind)) result.value[count] = *number;
    ++count;
    i = text.find_first_not_of(kBlanks, end);
  }
  if (count != numbers_in(kind))
    result.fault = fmt::format(
        "{} number{} where {} {} needed",
        count > kCounted ? fmt::format("more than {}", kCounted) : std::to_string(count),
        count == 1 ? "" : "s", numbers_in(kind), numbers_in(kind) == 1 ? "is" : "are");
  return result;
}

}  // namespace arboc

// Numbers as text and back, without locale and without loss.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace arboc {

/// The shortest decimal text that reads back as exactly this double: 0.1, 1e-09, -9.81, inf, nan.
std::string shortest(double value);

/// The same as a C++ literal of type double: always with a point or an exponent ("1.0", "1e-09").
/// Finite values only.
std::string literal(double value);

/// The double that the whole of `text` spells ("1", "-2.5e-3", "+.5"), correctly rounded; nothing
/// if any other character is there, and nothing for "inf", "nan", hexadecimal or out of range.
std::optional<double> parse_finite(std::string_view text);

}  // namespace arboc

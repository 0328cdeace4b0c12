// User text on its way into generated code: identifiers, comments and string literals.
#pragma once
#include <string>
#include <string_view>

namespace arboc {

/// An identifier that is valid in C and C++ and no keyword, macro or word of the libraries' headers
/// or of the generated interface (reserved_words.txt): other bytes become '_', runs of '_' one; "model" if nothing is left.
std::string identifier(std::string_view text);

/// For macros: a letter in lower case becomes upper case.
std::string upper_case(std::string_view text);

/// Safe inside a // comment: anything but letters, digits, space and _.,:+-'()[]= becomes '_'.
std::string comment_text(std::string_view text);

/// A C string literal with its quotes; bytes outside printable ASCII in octal.
std::string string_literal(std::string_view text);

}  // namespace arboc

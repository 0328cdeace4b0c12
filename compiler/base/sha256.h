// SHA-256 of a text, as 64 hexadecimal digits (libcrypto does the work).
#pragma once
#include <string>
#include <string_view>

namespace arboc {

std::string sha256(std::string_view bytes);

}  // namespace arboc

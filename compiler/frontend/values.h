// Attribute text -> numbers, without locale, each number finite and spelt out in full.
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "frontend/schema.h"

namespace arboc {

struct Numbers {
  std::array<double, 4> value{};
  std::string fault{};  ///< what is wrong with the text; empty: nothing
  std::string hint{};
};

/// As many numbers as `kind` has, between blanks.
Numbers parse_numbers(std::string_view text, Value kind);

}  // namespace arboc

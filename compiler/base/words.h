// What a misspelt word was probably meant to be.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace arboc {

/// The word among `known` that `word` most likely means: it differs in the case of letters only,
/// or by so few letters typed wrong, left out, added or swapped that a typo is likely.
std::string nearest(std::string_view word, const std::vector<std::string_view>& known);

/// Equal but for the case of ASCII letters.
bool equal_but_for_case(std::string_view a, std::string_view b);

}  // namespace arboc

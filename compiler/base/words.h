// Words of lists, and what a misspelt one was probably meant to be.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace arboc {

/// "a,b" -> a, b; nothing behind a comma at the end.
std::vector<std::string> split(const std::string& list);

/// The word among `known` that `word` most likely means: it differs in the case of letters only,
/// or by so few letters typed wrong, left out, added or swapped that a typo is likely.
std::string nearest(std::string_view word, const std::vector<std::string_view>& known);

/// User text cut to a readable length, between single quotes.
std::string quoted(std::string_view text);

/// "OPTION: there is no link 'WORD' (did you mean 'WORK'?)", or which are known: all, or the first
/// ones of more than `most`.  `what` is "there is no link"; bytes that would not print are escaped.
std::string unknown(std::string_view option, std::string_view what, std::string_view word,
                    const std::vector<std::string_view>& known, size_t most = 8);

/// Equal but for the case of ASCII letters.
bool equal_but_for_case(std::string_view a, std::string_view b);

}  // namespace arboc

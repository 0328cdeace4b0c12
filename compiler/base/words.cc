#include "base/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "base/diagnostic.h"

namespace arboc {

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream in(list);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Letters typed wrong, left out, added or swapped with their neighbour between `a` and `b`.
size_t typing_errors(std::string_view a, std::string_view b) {
  const size_t width = b.size() + 1;
  std::vector<size_t> d((a.size() + 1) * width);
  const auto cell = [&](size_t i, size_t j) -> size_t& { return d[i * width + j]; };
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cell(i, j) = i + j;
        continue;
      }
      cell(i, j) = std::min({cell(i - 1, j) + 1, cell(i, j - 1) + 1,
                             cell(i - 1, j - 1) + (lower(a[i - 1]) != lower(b[j - 1]))});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cell(i, j) = std::min(cell(i, j), cell(i - 2, j - 2) + 1);
    }
  }
  return d.back();
}

}  // namespace

bool equal_but_for_case(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                            [](char x, char y) { return lower(x) == lower(y); });
}

std::string nearest(std::string_view word, const std::vector<std::string_view>& known) {
  constexpr size_t kLongestWord = 64;
  if (word.size() > kLongestWord) return "";
  std::string best;
  size_t fewest = 3;
  for (const std::string_view candidate : known) {
    const size_t tolerated = candidate.size() <= 2 ? 0 : candidate.size() <= 5 ? 1 : 2;
    const size_t longer = std::max(word.size(), candidate.size());
    if (longer - std::min(word.size(), candidate.size()) > tolerated) continue;
    const size_t errors = typing_errors(word, candidate);
    if (errors <= tolerated && errors < fewest) {
      fewest = errors;
      best = candidate;
    }
  }
  return best;
}

std::string quoted(std::string_view text) {
  constexpr size_t kReadable = 80;
  if (text.size() <= kReadable) return fmt::format("'{}'", text);
  size_t end = kReadable;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // whole letters
  return fmt::format("'{}...'", text.substr(0, end));
}

std::string unknown(std::string_view option, std::string_view what, std::string_view word,
                    const std::vector<std::string_view>& known, size_t most) {
  std::string hint = known.empty() ? "there is none" : "known are ";
  for (size_t k = 0; k < known.size() && k < most; ++k) hint += (k ? ", " : "") + quoted(known[k]);
  if (known.size() > most) hint += ", ...";
  const std::string meant = nearest(word, known);
  if (!meant.empty()) hint = fmt::format("did you mean {}?", quoted(meant));
  return printable(fmt::format("{}: {} {} ({})", option, what, quoted(word), hint));
}

}  // namespace arboc

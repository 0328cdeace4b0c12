#include "base/words.h"

#include <algorithm>

namespace arboc {
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

}  // namespace arboc

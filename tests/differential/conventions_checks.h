// Examples in words of docs/conventions.md, and what holds them.
#pragma once
#include <ostream>
#include <vector>

namespace arboc::test {

struct WordCheck {
  const char* name;   ///< of the test
  const char* words;  ///< as in the page, but for runs of blanks
  void (*check)();
};

inline void PrintTo(const WordCheck& check, std::ostream* out) { *out << check.words; }

std::vector<WordCheck> joint_checks();       ///< placements, joints, orders
std::vector<WordCheck> derivative_checks();  ///< mimic joints and all behind them

}  // namespace arboc::test

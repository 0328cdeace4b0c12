// Where the statements of a chunk store their values, as lines of C++.
#pragma once
#include <string>
#include <vector>

#include "program/program.h"

namespace arboc {

/// Per statement the lines that follow it.  Lanes of one vector are stored together (scatter); four
/// vectors whose lanes go to consecutive places are transposed first, after the last of them, so
/// that four rows are stored instead of sixteen values (store_rows).
std::vector<std::vector<std::string>> store_lines(const Program& program, const Chunk& chunk);

}  // namespace arboc

// Tables of docs/coverage.md: measured errors become bounds, committed bounds are compared with.
//
// Errors are published as decades with room above them, so that another machine's rounding stays
// below: a bound is the next power of ten above three times the error.  A run compares labels and
// words exactly, and errors with bounds; ARBOC_UPDATE=1 rewrites the table of the test instead.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace arboc::test {

struct TableEntry {
  /// One number a base, in the order of the heading; "gap [n]", or "" for nothing.
  std::vector<std::optional<double>> errors;
  std::string gap;
};

struct TableRow {
  std::vector<std::string> words;  ///< label, order, how verified ...
  std::vector<TableEntry> entries;
};

struct CoverageTable {
  std::string name;                ///< of the markers in the file
  std::vector<std::string> heads;  ///< of words, then of entries
  std::vector<TableRow> rows;
  std::vector<std::string> notes;  ///< printed below, numbered from 1
};

/// 1e-14 or the next decade above three times the error.
std::string bound(double error);

/// Fails where the committed table differs or is exceeded.
void expect_committed(const CoverageTable& table);

}  // namespace arboc::test

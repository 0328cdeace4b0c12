// Two motions over time, one computed and one captured: how far apart they are, column by column.
#pragma once
#include "csv.h"

namespace study {

/// Columns of numbers under names.
struct Columns {
  std::vector<std::string> names;
  Rows values;

  int find(const std::string& name) const;  ///< -1: no such column
};
/// Throws std::invalid_argument with file and line.
Columns read_csv(const std::string& path);

struct Difference {
  std::string column;
  double rmse = 0, largest = 0, at = 0;  ///< in the column's unit; s
};
/// Of all columns that both have and whose names begin with `prefix`, at the instants of the first
/// that lie within the second, which is interpolated linearly; `shift` (s) is added to its times.
/// Throws std::invalid_argument where there is no column `t`, no common column, or no common time.
std::vector<Difference> compare(const Columns& simulated, const Columns& captured,
                                const std::string& prefix, double shift = 0);

}  // namespace study

// Columns of numbers over time, as motion capture, force plates and OpenSim write and read them.
#pragma once
#include <string>
#include <vector>

#include "csv.h"

namespace study {

struct Recording {
  std::string name;
  std::vector<std::string> columns;
  Eigen::VectorXd times;  ///< s, rising
  Rows values;            ///< one row an instant
  bool degrees = false;   ///< angles are in degrees
};

/// By the end of its name: .mot and .sto (OpenSim), .trc (markers, columns `NAME x`, ...; m) and
/// .csv (a line of names, the first column is time).  Numbers are as they stand in the file, but
/// for markers.  Throws std::invalid_argument with file and line.
Recording read_recording(const std::string& path);

/// Text of a .mot or .sto file.
std::string opensim_text(const Recording& recording);
/// Text of a .trc file, mm, of columns in threes.
std::string trc_text(const Recording& markers);

/// How far one recording is from another in a column that both have.
struct Difference {
  std::string column;
  int instants = 0;
  double rmse = 0, largest = 0;  ///< in the column's unit
  double at = 0;                 ///< s, of the largest
  double correlation = 0;        ///< of Pearson; 0 where one does not change
};
/// Of the columns whose names begin with `prefix`, at the instants of `measured` that lie within
/// `predicted`, which is interpolated linearly.  Throws std::invalid_argument where nothing is
/// common.
std::vector<Difference> compare(const Recording& predicted, const Recording& measured,
                                const std::string& prefix = "");
std::string comparison_csv(const std::vector<Difference>& differences);

}  // namespace study

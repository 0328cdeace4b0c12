// Lines over an axis, as SVG.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace study {

struct Line {
  std::string name;
  Eigen::VectorXd x, y;  ///< of one size; NaN breaks the line
};

struct Plot {
  std::string title, x_label, y_label;
  std::vector<Line> lines;
  std::vector<double> marks{};  ///< vertical lines at these x
  bool log_y = false;           ///< values that are not positive break the line
  int width = 760, height = 300;
};

/// A whole SVG file, without scripts.  Lines of many points are thinned so that every extreme
/// stays. A page may move the line of class `now`: its data-x0 data-x1 are where data-t0 data-t1
/// stand. Throws std::invalid_argument where x and y differ in size.
std::string svg(const Plot& plot);

/// Multiples of 1, 2 or 5 times a power of ten in [low, high]; at most `most` + 1.
std::vector<double> ticks(double low, double high, int most);

}  // namespace study

// Numbers -> CSV, 17 digits.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace study {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// One line of names, then the rows.  `columns` blocks stand side by side, all of as many rows as
/// there are names' worth of columns in total; throws std::invalid_argument where that fails.
std::string csv(const std::vector<std::string>& names, const std::vector<Rows>& columns);

/// prefix + each name: "tau." of joints, say.
std::vector<std::string> prefixed(const std::string& prefix, const std::vector<std::string>& names);

}  // namespace study

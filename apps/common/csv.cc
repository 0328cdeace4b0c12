#include "csv.h"

#include <fmt/format.h>

#include <iterator>
#include <stdexcept>

namespace study {

std::string csv(const std::vector<std::string>& names, const std::vector<Rows>& columns) {
  Eigen::Index width = 0;
  for (const Rows& block : columns) {
    width += block.cols();
    if (block.rows() != columns[0].rows()) throw std::invalid_argument("csv: rows differ");
  }
  if (width != static_cast<Eigen::Index>(names.size()))
    throw std::invalid_argument("csv: not one name for each column");
  std::string out;
  for (std::size_t k = 0; k < names.size(); ++k) out += (k ? "," : "") + names[k];
  out += '\n';
  const Eigen::Index rows = columns.empty() ? 0 : columns[0].rows();
  for (Eigen::Index r = 0; r < rows; ++r) {
    const char* separator = "";
    for (const Rows& block : columns) {
      for (Eigen::Index c = 0; c < block.cols(); ++c) {
        fmt::format_to(std::back_inserter(out), "{}{:.17g}", separator, block(r, c));
        separator = ",";
      }
    }
    out += '\n';
  }
  return out;
}

std::vector<std::string> prefixed(const std::string& prefix,
                                  const std::vector<std::string>& names) {
  std::vector<std::string> out;
  for (const std::string& name : names) out.push_back(prefix + name);
  return out;
}

}  // namespace study

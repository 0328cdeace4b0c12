#include "compare.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace study {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) {
    if (!cell.empty() && cell.back() == '\r') cell.pop_back();
    out.push_back(cell);
  }
  return out;
}

double number(const std::string& cell, const std::string& where) {
  char* end = nullptr;
  const double x = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0')
    throw std::invalid_argument(where + ": '" + cell + "' is not a number");
  return x;
}

Eigen::VectorXd times(const Columns& c, const char* which) {
  const int t = c.find("t");
  if (t < 0 || c.values.rows() < 2)
    throw std::invalid_argument(std::string(which) + ": no column t, or fewer than two rows");
  for (Eigen::Index k = 1; k < c.values.rows(); ++k)
    if (!(c.values(k, t) > c.values(k - 1, t)))
      throw std::invalid_argument(std::string(which) + ": times do not rise");
  return c.values.col(t);
}

}  // namespace

int Columns::find(const std::string& name) const {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : static_cast<int>(at - names.begin());
}

Columns read_csv(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  if (!in || !std::getline(in, line)) throw std::invalid_argument(path + ": cannot be read");
  Columns out{cells(line), {}};
  std::vector<double> all;
  int row = 1;
  while (std::getline(in, line)) {
    const std::string where = path + ":" + std::to_string(++row);
    if (line.empty()) continue;
    const std::vector<std::string> parts = cells(line);
    if (parts.size() != out.names.size())
      throw std::invalid_argument(where + ": " + std::to_string(parts.size()) + " cells under " +
                                  std::to_string(out.names.size()) + " names");
    for (const std::string& cell : parts) all.push_back(number(cell, where));
  }
  const auto width = static_cast<Eigen::Index>(out.names.size());
  out.values =
      Eigen::Map<const Rows>(all.data(), static_cast<Eigen::Index>(all.size()) / width, width);
  return out;
}

std::vector<Difference> compare(const Columns& simulated, const Columns& captured,
                                const std::string& prefix, double shift) {
  const Eigen::VectorXd t = times(simulated, "the first motion");
  const Eigen::VectorXd u = times(captured, "the second motion").array() + shift;
  std::vector<Difference> out;
  for (std::size_t c = 0; c < simulated.names.size(); ++c) {
    const std::string& name = simulated.names[c];
    const int other = captured.find(name);
    if (name == "t" || other < 0 || name.compare(0, prefix.size(), prefix) != 0) continue;
    Difference d{name};
    Eigen::Index after = 1, count = 0;
    for (Eigen::Index k = 0; k < t.size(); ++k) {
      if (t[k] < u[0] || t[k] > u[u.size() - 1]) continue;
      while (u[after] < t[k]) ++after;
      const double part = (t[k] - u[after - 1]) / (u[after] - u[after - 1]);
      const double there =
          (1 - part) * captured.values(after - 1, other) + part * captured.values(after, other);
      const double miss = simulated.values(k, static_cast<Eigen::Index>(c)) - there;
      d.rmse += miss * miss;
      ++count;
      if (std::fabs(miss) > d.largest) d.largest = std::fabs(miss), d.at = t[k];
    }
    if (count == 0) throw std::invalid_argument("the two motions have no time in common");
    d.rmse = std::sqrt(d.rmse / static_cast<double>(count));
    out.push_back(d);
  }
  if (out.empty())
    throw std::invalid_argument("the two motions have no column '" + prefix + "...' in common");
  return out;
}

}  // namespace study

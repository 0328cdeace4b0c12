#include "cli/csv.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/diagnostic.h"
#include "base/number.h"

namespace arboc::cli {

std::vector<std::vector<double>> read_csv(const std::string& path, int columns,
                                          const std::string& input) {
  std::ifstream in(path);
  if (!in)
    throw InputError(
        fmt::format("{}: error: cannot open: {}", printable(path), std::strerror(errno)));
  std::vector<std::vector<double>> rows;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.find_first_not_of(" \t") == std::string::npos) continue;
    const auto fail = [&](const std::string& what) {
      throw InputError(fmt::format("{}:{}: error: {}", printable(path), number, what));
    };
    std::vector<double> row;
    for (size_t at = 0; at <= line.size();) {
      const size_t end = std::min(line.find(',', at), line.size());
      std::string cell = line.substr(at, end - at);
      cell.erase(0, std::min(cell.find_first_not_of(" \t"), cell.size()));
      cell.erase(cell.find_last_not_of(" \t") + 1);
      const auto value = parse_finite(cell);
      if (!value) fail(fmt::format("'{}' is not a finite number", printable(cell)));
      row.push_back(*value);
      at = end + 1;
    }
    if (row.size() != static_cast<size_t>(columns))
      fail(fmt::format("{} numbers, but {} has {} (one state a line)", row.size(), input, columns));
    rows.push_back(std::move(row));
  }
  if (in.bad() || (!in.eof() && in.fail()))
    throw InputError(
        fmt::format("{}: error: cannot read: {}", printable(path), std::strerror(errno)));
  if (rows.empty())
    throw InputError(fmt::format("{}: error: no states in the file", printable(path)));
  return rows;
}

std::string csv_line(const std::vector<double>& values) {
  std::string out;
  for (const double x : values) out += fmt::format("{}{:.17g}", out.empty() ? "" : ",", x);
  return out + "\n";
}

}  // namespace arboc::cli

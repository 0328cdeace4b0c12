#include "cli/csv.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/diagnostic.h"
#include "base/number.h"

namespace arboc::cli {
namespace {

constexpr size_t kMaxLineBytes = size_t{64} << 20;
constexpr size_t kMaxBytes = size_t{1} << 30;

/// std::getline that ends.  `bytes` counts those of the file; beyond kMaxBytes, or in a longer
/// line, they are set to kTooMany and there is no line.
constexpr size_t kTooMany = ~size_t{0};
bool next_line(std::istream& in, std::string& line, size_t& bytes) {
  line.clear();
  for (int c = 0; (c = in.get()) != std::istream::traits_type::eof();) {
    if (c == '\n') return true;
    if (++bytes > kMaxBytes || line.size() == kMaxLineBytes) {
      bytes = kTooMany;
      return false;
    }
    line += static_cast<char>(c);
  }
  return !line.empty();
}

}  // namespace

std::vector<std::vector<double>> read_csv(const std::string& path, int columns,
                                          const std::string& input) {
  std::ifstream in(path);
  if (!in)
    throw InputError(
        fmt::format("{}: error: cannot open: {}", printable(path), std::strerror(errno)));
  std::vector<std::vector<double>> rows;
  std::string line;
  size_t bytes = 0;
  for (int number = 1; next_line(in, line, bytes); ++number) {
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
  if (bytes == kTooMany)
    throw InputError(fmt::format("{}: error: is too large: the limit is {} MiB, and {} MiB a line",
                                 printable(path), kMaxBytes >> 20, kMaxLineBytes >> 20));
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

// Numbers in and out as comma-separated lines, one state a line, no header.
#pragma once
#include <string>
#include <vector>

namespace arboc::cli {

/// Reads a file whose every line has the `columns` numbers of `input`.  Throws InputError that names
/// file, line and remedy; endless input ends at 1 GiB, or 64 MiB of one line.
std::vector<std::vector<double>> read_csv(const std::string& path, int columns,
                                          const std::string& input);

/// A line with 17 significant digits a number, which read back exactly.
std::string csv_line(const std::vector<double>& values);

}  // namespace arboc::cli

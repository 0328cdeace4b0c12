#include "differential/proof_table.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <cmath>
#include <sstream>

#include "support/golden.h"

namespace arboc::test {
namespace {

const std::string kPath = ARBOC_SOURCE_DIR "/docs/coverage.md";

std::string begin_marker(const std::string& name) {
  return fmt::format("<!-- {}: written by proof_test -->\n", name);
}
std::string end_marker(const std::string& name) {
  return fmt::format("<!-- end of {} -->\n", name);
}

std::string print(const TableEntry& entry) {
  if (!entry.gap.empty()) return entry.gap;
  std::vector<std::string> bounds;
  for (const auto& error : entry.errors) bounds.push_back(error ? bound(*error) : "-");
  return fmt::format("{}", fmt::join(bounds, " / "));
}

/// Cells of each line of the table.
using Lines = std::vector<std::vector<std::string>>;

Lines lines_of(const CoverageTable& table) {
  Lines lines{table.heads, std::vector<std::string>(table.heads.size(), "---")};
  for (const TableRow& row : table.rows) {
    lines.push_back(row.words);
    for (const TableEntry& entry : row.entries) lines.back().push_back(print(entry));
  }
  return lines;
}

std::string text_of(const CoverageTable& table) {
  std::string out;
  for (const auto& line : lines_of(table)) out += fmt::format("| {} |\n", fmt::join(line, " | "));
  if (!table.notes.empty()) out += "\n";
  for (size_t k = 0; k < table.notes.size(); ++k)
    out += fmt::format("{}[{}] {}.\n", k == 0 ? "" : "\n", k + 1, table.notes[k]);
  return out;
}

/// The committed text between the markers.
std::string committed(const std::string& file, const std::string& name) {
  const size_t begin = file.find(begin_marker(name)), end = file.find(end_marker(name));
  if (begin == std::string::npos || end == std::string::npos) return "";
  const size_t first = begin + begin_marker(name).size();
  return file.substr(first, end - first);
}

/// Other tests of this program may write at the same time.
void rewrite(const CoverageTable& table) {
  const int lock = open(kPath.c_str(), O_RDONLY);
  ASSERT_GE(lock, 0) << kPath;
  flock(lock, LOCK_EX);
  std::string file = read_file(kPath);
  const size_t begin = file.find(begin_marker(table.name)), end = file.find(end_marker(table.name));
  if (begin == std::string::npos || end == std::string::npos) {
    ADD_FAILURE() << kPath << " has no place for " << table.name;
  } else {
    const size_t first = begin + begin_marker(table.name).size();
    write_file(kPath, file.replace(first, end - first, text_of(table)));
  }
  close(lock);
}

std::vector<std::string> split(const std::string& text, const std::string& by) {
  std::vector<std::string> parts;
  size_t from = 0;
  for (size_t at; (at = text.find(by, from)) != std::string::npos; from = at + by.size())
    parts.push_back(text.substr(from, at - from));
  parts.push_back(text.substr(from));
  return parts;
}

/// An entry within what was committed: the same gaps, errors at or below the bounds.
bool within(const TableEntry& entry, const std::string& published) {
  if (!entry.gap.empty()) return published == entry.gap;
  const std::vector<std::string> bounds = split(published, " / ");
  if (bounds.size() != entry.errors.size()) return false;
  for (size_t k = 0; k < bounds.size(); ++k) {
    if (!entry.errors[k] || bounds[k] == "-") {
      if (entry.errors[k] || bounds[k] != "-") return false;
      continue;
    }
    std::istringstream number(bounds[k]);
    double limit = -1;
    number >> limit;
    if (!(*entry.errors[k] <= 3 * limit)) return false;  // another machine rounds otherwise
  }
  return true;
}

void compare_row(const TableRow& row, const std::string& line) {
  const std::string inside = line.size() < 4 ? "" : line.substr(2, line.size() - 4);
  const std::vector<std::string> cells = split(inside, " | ");
  ASSERT_EQ(cells.size(), row.words.size() + row.entries.size()) << line;
  for (size_t k = 0; k < row.words.size(); ++k) EXPECT_EQ(cells[k], row.words[k]) << row.words[0];
  for (size_t k = 0; k < row.entries.size(); ++k) {
    const std::string& published = cells[row.words.size() + k];
    EXPECT_TRUE(within(row.entries[k], published))
        << row.words[0] << ", column " << k + 1 << ": " << print(row.entries[k])
        << ", but committed is " << published;
  }
}

}  // namespace

std::string bound(double error) {
  if (!std::isfinite(error)) return "inf";
  return fmt::format("1e{}", std::max(-14, static_cast<int>(std::ceil(std::log10(3 * error)))));
}

void expect_committed(const CoverageTable& table) {
  if (updating()) return rewrite(table);
  const std::string again = "\nIf the change is meant, run the test again with ARBOC_UPDATE=1.";
  const std::string text = committed(read_file(kPath), table.name);
  const std::vector<std::string> published = split(text, "\n"), now = split(text_of(table), "\n");
  ASSERT_EQ(published.size(), now.size()) << table.name << again;
  for (size_t k = 0; k < now.size(); ++k) {
    if (k >= 2 && k - 2 < table.rows.size())
      compare_row(table.rows[k - 2], published[k]);
    else
      EXPECT_EQ(published[k], now[k]);
  }
  EXPECT_FALSE(testing::Test::HasFailure()) << table.name << again;
}

}  // namespace arboc::test

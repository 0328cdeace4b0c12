// The functions and costs that docs/functions.md lists are those of the catalogue and of
// bench/opcount/opcount.txt; ARBOC_UPDATE=1 rewrites the costs.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <vector>

#include "functions/catalogue.h"
#include "support/golden.h"

namespace arboc::test {
namespace {

bool is_function(const std::string& name) {
  const std::vector<std::string> names = function_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

const std::string kPage = ARBOC_SOURCE_DIR "/docs/functions.md";

using Totals = std::map<std::string, std::string>;  ///< by model and function

Totals totals() {
  Totals all;
  std::istringstream table(read_file(ARBOC_SOURCE_DIR "/bench/opcount/opcount.txt"));
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    std::string model, function, total;
    words >> model >> function;
    while (words >> total) {
    }
    all[model + " " + function] = total;
  }
  return all;
}

/// The function of a row `| `name` | ...`, and how many cells follow.
std::string function_of(const std::string& line, long& cells) {
  cells = std::count(line.begin(), line.end(), '|') - 2;
  const size_t end = line.find('`', 3);
  return line.starts_with("| `") && end != std::string::npos ? line.substr(3, end - 3) : "";
}

TEST(CostTable, EqualsTheCounts) {
  const Totals all = totals();
  std::istringstream page(read_file(kPage));
  std::string text;
  int rows = 0;
  for (std::string line; std::getline(page, line); text += line + "\n") {
    long cells = 0;
    const std::string function = function_of(line, cells);
    if (cells != 3 || !is_function(function)) continue;
    line = "| `" + function + "` |";
    for (const char* model : {"ur5 ", "quadruped ", "humanoid "})
      line += " " + all.at(model + function) + " |";
    ++rows;
  }
  EXPECT_EQ(rows, static_cast<int>(function_names().size()));
  expect_golden(kPage, text);
}

TEST(CostTable, EveryFunctionIsListedWithItsInputs) {
  std::istringstream page(read_file(kPage));
  std::vector<std::string> listed;
  for (std::string line; std::getline(page, line);) {
    long cells = 0;
    const std::string function = function_of(line, cells);
    if (cells == 4 && is_function(function)) listed.push_back(function);
  }
  EXPECT_EQ(listed, function_names());
}

}  // namespace
}  // namespace arboc::test

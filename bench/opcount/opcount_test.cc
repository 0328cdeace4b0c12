// Recounts the operations of every function of the project's own models and compares them with
// opcount.txt; ARBOC_UPDATE=1 rewrites the table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compile.h"
#include "frontend/read_model.h"
#include "support/golden.h"

namespace arboc::test {
namespace {

struct Row {
  const char* model;
  Base base;
};

constexpr Row kModels[] = {
    {"double_pendulum", Base::kFixed}, {"ur5", Base::kFixed},         {"arm7", Base::kFixed},
    {"quadruped", Base::kFloating},    {"humanoid", Base::kFloating}, {"all_joints", Base::kFixed},
};

std::string lines(const Row& row) {
  const std::string name = row.model;
  Diagnostics diagnostics;
  ModelOptions options;
  options.base = row.base;
  const Model model =
      configure(read_model(ARBOC_SOURCE_DIR "/models/" + name + "/" + name + ".urdf", diagnostics),
                options, diagnostics);
  std::string out;
  for (const std::string& function : function_names()) {
    const OpCount n = compile_function({function}, resolve(model)).program.ops;
    out += fmt::format("{:<16} {:<30} {:>6} {:>6} {:>6} {:>4} {:>5} {:>7} {:>6}\n", name, function,
                       n.mul, n.add, n.fma, n.div, n.sqrt, n.sincos, n.total());
  }
  return out;
}

TEST(OpCount, EqualsTheTable) {
  std::string table =
      fmt::format("{:<16} {:<30} {:>6} {:>6} {:>6} {:>4} {:>5} {:>7} {:>6}\n", "model", "function",
                  "mul", "add", "fma", "div", "sqrt", "sincos", "total");
  for (const Row& row : kModels) table += lines(row);
  expect_golden(ARBOC_SOURCE_DIR "/bench/opcount/opcount.txt", table);
}

}  // namespace
}  // namespace arboc::test

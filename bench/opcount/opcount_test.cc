// Recounts the operations of every function of the project's own models and compares them with
// opcount.txt, simplifications.txt and limbs.txt; ARBOC_UPDATE=1 rewrites the table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>

#include "compile.h"
#include "counted.h"
#include "frontend/read_model.h"
#include "support/golden.h"

namespace arboc::test {
namespace {

struct Row {
  const char* model;
  Base base;
  const char* extension = ".urdf";
};

constexpr Row kModels[] = {
    {"double_pendulum", Base::kFixed},
    {"ur5", Base::kFixed},
    {"arm7", Base::kFixed},
    {"quadruped", Base::kFloating},
    {"humanoid", Base::kFloating},
    {"all_joints", Base::kFixed},
    {"santos", Base::kFile, ".dh.toml"},
    {"nine_dof", Base::kFile, ".dh.toml"},
    {"astronaut_turn", Base::kFile, ".dh.toml"},
    {"astronaut_ladder", Base::kFile, ".dh.toml"},
    {"arm7_dh", Base::kFile, ".dh.toml"},
};

Model model_of(const Row& row) {
  const std::string name = row.model;
  Diagnostics diagnostics;
  ModelOptions options;
  options.base = row.base;
  return configure(
      read_model(ARBOC_SOURCE_DIR "/models/" + name + "/" + name + row.extension, diagnostics),
      options, diagnostics);
}

/// Nothing if the model cannot have the function, as its inertia is singular.
std::optional<CompiledFunction> compiled(const std::string& function, const Setup& setup) {
  try {
    return compile_function({function}, setup);
  } catch (const AbsentError&) {
    return std::nullopt;
  }
}

std::string lines(const Row& row) {
  const std::string name = row.model;
  const Model model = model_of(row);
  std::string out;
  for (const std::string& function : function_names()) {
    const auto f = compiled(function, resolve(model));
    if (!f) continue;
    const OpCount n = f->program.ops;
    out += fmt::format("{:<16} {:<30} {:>6} {:>6} {:>6} {:>4} {:>5} {:>7} {:>6}\n", name, function,
                       n.mul, n.add, n.fma, n.div, n.sqrt, n.sincos, n.total());
  }
  return out;
}

/// Operations of one function with some simplification left out.
int total(const Model& model, const std::string& function, const Simplifications& simplify) {
  FunctionOptions options;
  options.simplify = simplify;
  return compile_function({function}, resolve(model, options)).program.ops.total();
}

/// The columns of simplifications.txt behind the first.
struct Column {
  const char* name;
  Simplifications simplify;
};
constexpr Column kColumns[] = {
    {"frames", {.frames = false}},
    {"regroup", {.regroup = false}},
    {"fuse", {.fuse = false}},
    {"dead", {.dead = false}},
    {"all", {.frames = false, .regroup = false, .fuse = false, .dead = false}},
};

/// What each simplification is worth: the counts without it.
std::string simplified_lines(const Row& row) {
  const Model model = model_of(row);
  std::string out;
  for (const char* function :
       {"fk", "rnea", "nle", "crba", "minv", "aba", "centroidal", "frame_jacobian",
        "rnea_derivatives", "aba_derivatives", "rnea_hessian"}) {
    if (std::string(row.model) == "santos" && std::string(function) == "rnea_hessian")
      continue;  // takes long
    if (!compiled(function, resolve(model))) continue;
    out += fmt::format("{:<16} {:<18} {:>7}", row.model, function, total(model, function, {}));
    for (const Column& column : kColumns)
      out += fmt::format(" {:>7}", total(model, function, column.simplify));
    const int generic = generic_operations(model, function);
    out += fmt::format(" {:>7}\n", generic > 0 ? fmt::format("{}", generic) : "-");
  }
  return out;
}

TEST(OpCount, OfEachSimplificationEqualsTheTable) {
  std::string table = fmt::format("{:<16} {:<18} {:>7}", "model", "without", "-");
  for (const Column& column : kColumns) table += fmt::format(" {:>7}", column.name);
  table += fmt::format(" {:>7}\n", "generic");
  for (const Row& row : kModels) table += simplified_lines(row);
  expect_golden(ARBOC_SOURCE_DIR "/bench/opcount/simplifications.txt", table);
}

/// What limbs in lanes are worth: operations of both programs, and the crossings.
std::string lane_lines(const Row& row) {
  const std::string name = row.model;
  const Setup setup = resolve(model_of(row));
  std::string out;
  for (const char* function : {"rnea", "nle", "gravity", "crba", "aba", "rnea_derivatives"}) {
    const auto f = compiled(function, setup);
    if (!f || !f->lanes) continue;
    const OpCount n = f->lanes->program.ops;
    out += fmt::format("{:<16} {:<18} {:>6} {:>8} {:>8} {:>6} {:>7}\n", name, function,
                       f->program.ops.total(), n.total(), n.pack, n.hsum, n.lane);
  }
  return out;
}

TEST(OpCount, OfLimbsInLanesEqualsTheTable) {
  std::string table = fmt::format("{:<16} {:<18} {:>6} {:>8} {:>8} {:>6} {:>7}\n", "model",
                                  "function", "plain", "in lanes", "gathers", "sums", "stores");
  for (const Row& row : kModels) table += lane_lines(row);
  expect_golden(ARBOC_SOURCE_DIR "/bench/opcount/limbs.txt", table);
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

// Every robot at hand on many random states: inverse dynamics, mass matrix, kinematics and forward
// dynamics of the program that is emitted, against the reference engine on the same snapped model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "support/engines.h"
#include "support/interpreter.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;

constexpr int kStates = 50;  // times ARBOC_TEST_STATES: 1000 in a full run

std::vector<std::string> robot_files() {
  std::vector<std::string> files;
  for (const char* folder : {ARBOC_SOURCE_DIR "/models", ARBOC_SOURCE_DIR "/../shared/urdf"})
    if (fs::is_directory(folder))
      for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".urdf") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

/// Dense, row-major, both triangles.
std::vector<double> dense(const CompiledFunction& f, size_t k, const std::vector<double>& values) {
  const Argument& a = f.signature.outputs[k];
  if (!a.sparse) return values;
  const auto cols = static_cast<size_t>(a.cols);
  std::vector<double> matrix(static_cast<size_t>(a.rows) * cols);
  for (size_t e = 0; e < values.size(); ++e) {
    const auto i = static_cast<size_t>(f.patterns[k].row[e]);
    const auto j = static_cast<size_t>(f.patterns[k].col[e]);
    matrix[i * cols + j] = values[e];
    if (a.symmetric) matrix[j * cols + i] = values[e];
  }
  return matrix;
}

/// Largest error as a part of what is allowed: 1e-12 of the largest entry, of forward dynamics
/// times the condition of M.
double worst_error(const Model& model, const CompiledFunction& f) {
  const Setup setup = resolve(model);
  const Reference reference(model);
  StateSource source(21);
  double worst = 0;
  for (size_t k = 0; k < seeds(kStates).size(); ++k) {
    const Values in = source.inputs(setup);
    std::vector<std::vector<double>> inputs;
    for (const Argument& a : f.signature.inputs) inputs.push_back(in.at(a.name));
    const auto got = interpret(f.program, inputs);
    const Values expected = evaluate_reference(f.request, setup, in);
    double allowed = 1e-12;
    if (f.signature.name == "aba") {
      for (const double pivot : got.back()) EXPECT_GT(pivot, 0);
      allowed *= condition(reference.crba(vector_of(in.at("q"))));
    }
    for (size_t p = 0; p < f.signature.outputs.size(); ++p) {
      const std::string& name = f.signature.outputs[p].name;
      const double error = relative_error(dense(f, p, got[p]), expected.at(name)) / allowed;
      if (!(error <= worst)) worst = error;
      if (std::isnan(error)) return error;
    }
  }
  return worst;
}

TEST(RobotStates, ProgramsAgreeWithTheReferenceEngine) {
  double largest = 0;
  const std::vector<std::string> files = robot_files();
  EXPECT_GE(files.size(), 6u);
  for (const std::string& file : files) {
    for (const Base base : {Base::kFixed, Base::kFloating}) {
      SCOPED_TRACE(file + (base == Base::kFixed ? ", fixed" : ", floating"));
      ModelOptions options;
      options.base = base;
      const Model model = model_from(file, options);
      std::vector<std::string> functions{"rnea", "crba", "fk"};
      const std::vector<std::string> known = functions_of(model);
      if (std::find(known.begin(), known.end(), "aba") != known.end()) functions.push_back("aba");
      for (const CompiledFunction& f : compilation_of(model, functions).functions) {
        const double worst = worst_error(model, f);
        EXPECT_LE(worst, 1) << f.signature.name;
        largest = std::max(largest, worst);
      }
    }
  }
  RecordProperty("largest", std::to_string(largest));
}

}  // namespace
}  // namespace arboc::test

#include "support/engines.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <filesystem>

#include "frontend/read_model.h"

namespace arboc::test {
namespace {

std::vector<double> list(const Eigen::VectorXd& x) { return {x.data(), x.data() + x.size()}; }

}  // namespace

std::string own_model_path(const std::string& name) {
  const std::string stem = ARBOC_SOURCE_DIR "/models/" + name + "/" + name;
  return stem + (std::filesystem::exists(stem + ".urdf") ? ".urdf" : ".dh.toml");
}

Model own_model(const std::string& name, const ModelOptions& options) {
  return model_from(own_model_path(name), options);
}

Model model_from(const std::string& path, const ModelOptions& options) {
  Diagnostics diagnostics;
  return configure(read_model(path, diagnostics), options, diagnostics);
}

Values inputs_of(const State& state) {
  return {{"q", list(state.q)},     {"v", list(state.v)},  {"a", list(state.a)},
          {"tau", list(state.tau)}, {"q1", list(state.q)}, {"lambda", list(state.tau)}};
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::MatrixXd matrix_of(const std::vector<double>& values, Eigen::Index rows) {
  return vector_of(values).reshaped<Eigen::RowMajor>(
      rows, static_cast<Eigen::Index>(values.size()) / rows);
}

double relative_error(const std::vector<double>& got, const std::vector<double>& expected) {
  if (got.size() != expected.size()) return INFINITY;
  double error = 0, scale = 0;
  for (size_t i = 0; i < expected.size(); ++i) {
    if (!(std::fabs(got[i] - expected[i]) <= error)) error = std::fabs(got[i] - expected[i]);
    scale = std::max(scale, std::fabs(expected[i]));
  }
  return error == 0 ? 0 : error / scale;
}

double condition(const Eigen::MatrixXd& M) {
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues();
  return eigenvalues.maxCoeff() / eigenvalues.minCoeff();
}

double tolerance(const std::string& function, const Reference& reference, const State& state) {
  constexpr double kRounding = 1e-12;
  if (!function.starts_with("aba") && function != "minv") return kRounding;
  return kRounding * std::max(1.0, condition(reference.crba(state.q)) / 1e3);
}

std::vector<Request> requests_of(const std::vector<std::string>& functions) {
  std::vector<Request> requests;
  for (const std::string& function : functions) requests.push_back({function});
  return requests;
}

Compilation compilation_of(const Model& model, const std::vector<std::string>& functions) {
  Compilation compilation{resolve(model), {}};
  for (const Request& request : requests_of(functions))
    compilation.functions.push_back(compile_function(request, compilation.setup));
  return compilation;
}

cli::GeneratedCode generated_code(const Model& model, const std::vector<std::string>& functions,
                                  const std::string& flags) {
  cli::Common common;
  if (!flags.empty()) common.cxxflags = flags;
  CompileOptions options;
  options.requests = requests_of(functions);
  return {common, target(compilation_of(model, functions), options)};
}

std::vector<std::string> functions_of(const Model& model) {
  try {
    compile_function({"aba"}, resolve(model));
    return {"fk",
            "rnea",
            "gravity",
            "nle",
            "crba",
            "minv",
            "aba",
            "rnea_derivatives",
            "aba_derivatives"};
  } catch (const InputError&) {
    return {"fk", "rnea", "gravity", "nle", "crba", "rnea_derivatives"};
  }
}

}  // namespace arboc::test

// One state by any engine, and how far two results may be apart.
#pragma once
#include <string>
#include <vector>

#include "cli/build.h"
#include "compile.h"
#include "reference/reference.h"
#include "state_source.h"
#include "support/random_state.h"
#include "truth.h"

namespace arboc::test {

/// The file of a model of models/.
std::string own_model_path(const std::string& name);
/// A model of models/, or of a path, configured.
Model own_model(const std::string& name, const ModelOptions& options = {});
Model model_from(const std::string& path, const ModelOptions& options = {});

/// q1 and lambda are taken from the state as well.
Values inputs_of(const State& state);
Eigen::VectorXd vector_of(const std::vector<double>& values);
/// A dense matrix of a result: row-major.
Eigen::MatrixXd matrix_of(const std::vector<double>& values, Eigen::Index rows);

/// Largest difference relative to the largest expected entry (not-a-number if there is one).
double relative_error(const std::vector<double>& got, const std::vector<double>& expected);

/// Largest eigenvalue over the smallest.
double condition(const Eigen::MatrixXd& M);

/// 1e-12: rounding of some hundred operations; solving with M amplifies it by M's condition,
/// seen up to 2e-16 times it.
double tolerance(const std::string& function, const Reference& reference, const State& state);

std::vector<Request> requests_of(const std::vector<std::string>& functions);

/// The stages up to Program for a configured model.
Compilation compilation_of(const Model& model, const std::vector<std::string>& functions);

/// The functions compiled by the C++ compiler; `flags` replace those that eval uses.
cli::GeneratedCode generated_code(const Model& model, const std::vector<std::string>& functions,
                                  const std::string& flags = "");

/// The functions of dynamics, or those of them that a model of singular inertia has.
std::vector<std::string> functions_of(const Model& model);

}  // namespace arboc::test

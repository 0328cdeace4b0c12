// The rows of the proof: what is asked for, and who else knows the answer.
#pragma once
#include "differential/proof_models.h"
#include "functions/catalogue.h"

namespace arboc::test {

struct Row {
  Request request;
  Variation variation{};

  std::string label() const;
  /// Of derivatives that were taken; of functions named *_derivatives 1.
  int order() const;
  /// Libraries that the tests of docs/coverage.md compare with; empty: none.
  std::string others() const;
};

/// Every function of the catalogue.
std::vector<Row> function_rows();
/// The Jacobian of every output of every function with respect to all its inputs.
std::vector<Row> jacobian_rows();
/// Gradients, products with Jacobians and Hessians of some outputs.
std::vector<Row> sample_rows();
/// Functions and derivatives with options of the setup.
std::vector<Row> option_rows();

}  // namespace arboc::test

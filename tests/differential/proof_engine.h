// The functions under test, as graphs after the passes, and how far two results are apart.
#pragma once
#include <Eigen/Core>
#include <map>

#include "functions/trace.h"
#include "reference/reference.h"

namespace arboc::test {

/// Calls functions of one setup; a graph is traced when it is first needed.
class ProofEngine {
 public:
  /// `lowering`: which of a function's.
  ProofEngine(Setup setup, size_t lowering) : setup_(std::move(setup)), lowering_(lowering) {}

  const Setup& setup() const { return setup_; }
  size_t lowering() const { return lowering_; }

  /// Dense outputs by name.  Throws what trace() throws.
  Values operator()(const Request& request, const Values& inputs);

 private:
  struct Entry {
    Signature signature;
    Graph graph;
    std::vector<Pattern> patterns;
  };
  const Entry& entry(const Request& request);

  Setup setup_;
  size_t lowering_;
  std::map<std::string, Entry> entries_;
};

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd as_vector(const std::vector<double>& x);
/// Of entries row by row.
MatrixXd as_matrix(const std::vector<double>& x, Eigen::Index rows);
std::vector<double> as_list(const VectorXd& x);

/// Largest difference relative to the largest expected entry, at least to 1; infinite where
/// something is not finite or sizes differ.
double apart(const MatrixXd& actual, const MatrixXd& expected);

/// Moves an input by a tangent vector.
Values displaced(const Reference& reference, Values inputs, const std::string& name,
                 const VectorXd& step);

}  // namespace arboc::test

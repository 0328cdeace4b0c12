// A point near another that meets all rows and bounds, quickly: damped Gauss-Newton steps of least
// length in units of the scales.  A start for a solver, and inverse kinematics.
#ifndef ARBOC_NLP_PROJECT_HPP
#define ARBOC_NLP_PROJECT_HPP

#include "nlp.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

struct ProjectOptions {
  double tolerance = 1e-6;  ///< of rows, in units of their scales
  int max_iterations = 100;
  double longest = 0.5;  ///< of a step, largest entry in units of the scales
};

struct Projection {
  bool met = false;
  std::vector<double> x;
  double violation = 0;  ///< largest, in units of the scales
  int iterations = 0;
};

/// Rows in bounds do not count.  Stops where the violation cannot be made smaller nearby.
Projection project(Nlp& nlp, std::vector<double> x, const ProjectOptions& options = {});

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_PROJECT_HPP

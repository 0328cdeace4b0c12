// The Lagrange-Newton iteration: Newton's method on the conditions of first order of a program with
// equalities only; [Astronaut] section 6.
//
//   F(x, l) = f(x) + l^T c(x)
//   [ F_xx  c_x^T ] [dx]     [ F_x ]
//   [ c_x   0     ] [dl] = - [ c   ],     x += dx,  l += dl
// It converges quadratically near a solution and not at all elsewhere, to minima, maxima and
// saddles alike: what came out is said.  Safeguards lead there from further away: a multiple of the
// identity on F_xx where that is not positive along the directions that rows leave free, and steps
// shortened until f + mu |c|_1 falls; near a minimum neither acts.  Programs with bounds and
// inequalities, or without a guess that is near, are for solver.hpp.
#ifndef ARBOC_NLP_LAGRANGE_NEWTON_HPP
#define ARBOC_NLP_LAGRANGE_NEWTON_HPP

#include "nlp.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

struct LagrangeNewtonOptions {
  int max_iterations = 50;
  /// Stops where |dx| <= tolerance |x| and |dl| <= tolerance |l|, or both are below it.
  double tolerance = 1e-9;
  bool safeguards = true;  ///< without: the iteration as written above
};

/// Before a step, and the step.
struct LagrangeNewtonStep {
  double objective, stationarity, violation;  ///< |F_x|, |c|
  double dx, dl, x, l;                        ///< norms
  double shift = 0;                           ///< of F_xx
  double fraction = 1;                        ///< of the step that was taken
};

struct LagrangeNewtonResult {
  bool converged = false;
  std::string stop_reason;
  std::vector<double> x, multipliers;
  double objective = 0, stationarity = 0, violation = 0;
  /// The Hessian is positive along all directions that the rows leave free.
  bool minimum = false;
  std::vector<LagrangeNewtonStep> log;
  double seconds = 0;
};

/// Throws std::invalid_argument where a variable has bounds or a row is no equality.
LagrangeNewtonResult lagrange_newton(Nlp& nlp, std::vector<double> x,
                                     const LagrangeNewtonOptions& options = {});

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_LAGRANGE_NEWTON_HPP

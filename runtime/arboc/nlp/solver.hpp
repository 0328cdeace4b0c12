// Solving an Nlp, and saying what came out.
//
// The solver is Ipopt (interior point, exact Hessians), behind this interface so that programs do
// not see it.  It works on x / scale and c / scale of the Nlp.
#ifndef ARBOC_NLP_SOLVER_HPP
#define ARBOC_NLP_SOLVER_HPP

#include <functional>

#include "nlp.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

enum class Status {
  kOptimal,     ///< first-order optimal to the tolerances
  kInfeasible,  ///< converged to a point where the violation cannot be made smaller nearby
  kStopped,     ///< by a limit, by the caller, or because no better point could be found
};
const char* text(Status status);

/// Multipliers at a solution, in the Nlp's own units: of sum lambda c(x) - z_lower (x - lower) -
/// ...
struct Multipliers {
  std::vector<double> rows, lower, upper;
};

/// How far a point is from what its rows or variables demand, a group of one name and unit.
struct GroupViolation {
  std::string name, unit;
  double largest = 0, norm = 0;
};

struct Progress {
  int iteration;
  double objective, violation;  ///< violation: largest, of rows in units of their scale
  /// A guess: as if errors went on to shrink by the factor an iteration that they have so far;
  /// negative where they have not.
  double seconds_left = -1;
  std::vector<GroupViolation> violations{};
};

struct SolverOptions {
  double tolerance = 1e-8;      ///< of optimality, scaled
  double row_tolerance = 1e-9;  ///< of rows, in units of their scale
  int max_iterations = 500;
  double max_seconds = 60;
  double objective_scale = 1;  ///< what counts as 1 of the objective
  /// Of OpenBLAS, where that is Ipopt's BLAS: on problems of some hundred variables more threads
  /// only wait for each other.
  int blas_threads = 1;
  /// Given: start from these multipliers too, close to the bounds that are active.
  const Multipliers* warm = nullptr;
  std::function<bool(const Progress&)> go_on = {};  ///< false stops
};

struct Solution {
  Status status = Status::kStopped;  ///< if stopped, x is the best point that was seen
  std::string reason;                ///< in words
  std::vector<double> x;
  Multipliers multipliers;
  double objective = 0;
  double kkt_error = 0;  ///< see kkt_error()
  double violation = 0;  ///< largest, of rows and bounds in units of their scales
  int iterations = 0;
  double seconds = 0;                                  ///< all of it
  double cpu_seconds = 0;                              ///< of the process meanwhile
  double derivative_seconds = 0, hessian_seconds = 0;  ///< of these in the Nlp; and its Hessians
};

/// From x; bounds are respected from the start.  Throws std::runtime_error where Ipopt cannot
/// begin.
Solution solve(Nlp& nlp, std::vector<double> x, const SolverOptions& options = {});

/// The larger of stationarity and complementarity of x / scale, c / scale and the objective /
/// objective_scale, over max(100, mean of the multipliers) / 100, as [Ipopt] (5).
double kkt_error(Nlp& nlp, const std::vector<double>& x, const Multipliers& multipliers,
                 double objective_scale);

/// Of all groups of rows and of variables, in their order.
std::vector<GroupViolation> violations(Nlp& nlp, const std::vector<double>& x);
/// The largest of rows and variables, in units of their scales.
double largest_violation(Nlp& nlp, const std::vector<double>& x);

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_SOLVER_HPP

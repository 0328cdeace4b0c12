#include "reference/differences.h"

#include <algorithm>
#include <cmath>

namespace arboc {
namespace {

/// rad or m.  Forces are trigonometric polynomials of second degree in each angle; a follower
/// multiplies the frequency.
double step_of(const Model& model) {
  double fastest = 1;
  for (const Coordinates::Entry& entry : coordinates(model).joint)
    fastest = std::max(fastest, std::fabs(entry.multiplier));
  return 0.01 / fastest;
}

}  // namespace

RneaDerivative differentiate_rnea(const Reference& reference, const Model& model,
                                  const RneaState& state) {
  const int n = reference.nv();
  const double h = step_of(model);
  RneaDerivative result{Eigen::MatrixXd(n, n), Eigen::MatrixXd(n, n)};
  for (int j = 0; j < n; ++j) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(n, j);
    const auto odd = [&](int k) -> Eigen::VectorXd {
      const auto tau = [&](double d) {
        return reference.rnea(reference.integrate(state.q, d * unit), state.v, state.a);
      };
      return tau(k * h) - tau(-k * h);
    };
    result.dtau_dq.col(j) = (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h);
    result.dtau_dv.col(j) = (reference.rnea(state.q, state.v + unit, state.a) -
                             reference.rnea(state.q, state.v - unit, state.a)) /
                            2;
  }
  return result;
}

}  // namespace arboc

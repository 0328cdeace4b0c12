#include "reference/differentiate.h"

#include <algorithm>
#include <cmath>

namespace arboc {

template <class S>
StateOf<S> moved(const ReferenceOf<S>& reference, StateOf<S> state, With with,
                 const VectorOf<S>& step) {
  switch (with) {
    case With::kQ: state.q = reference.integrate(state.q, step); break;
    case With::kV: state.v += step; break;
    case With::kA: state.a += step; break;
    case With::kTau: state.tau += step; break;
  }
  return state;
}

template State moved(const Reference&, State, With, const Eigen::VectorXd&);
template ComplexState moved(const ComplexReference&, ComplexState, With, const VectorOf<Complex>&);

ComplexState complex(const State& state) {
  return {state.q.cast<Complex>(), state.v.cast<Complex>(), state.a.cast<Complex>(),
          state.tau.cast<Complex>()};
}

// Forces are trigonometric polynomials of second degree in each angle; a follower multiplies the
// frequency.
double complex_step::difference_step(const ComplexReference& reference) {
  double fastest = 1;
  for (const auto& body : reference.bodies())
    fastest = std::max(fastest, std::fabs(body.at.multiplier));
  return 0.01 / fastest;
}

}  // namespace arboc

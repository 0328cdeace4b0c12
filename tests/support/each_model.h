// Random models with a state each, and how far two results are apart.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "reference/differentiate.h"
#include "support/random_model.h"
#include "support/random_state.h"

namespace arboc::test {

/// check(model, reference, state) for `count` random models of every joint type, half of them on a
/// floating base; every joint has a spring, a damper, friction and a rotor, for those who ask.
template <class Check>
void for_each_model(int count, const Check& check) {
  for (const std::uint64_t seed : seeds(count)) {
    RandomModelOptions options;
    options.base = seed % 2 ? Base::kFixed : Base::kFloating;
    options.exotic = seed % 4 < 2;
    options.mimic = seed % 3 != 0;  // followers have another forward dynamics
    Model model = random_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
    Random random(seed);
    for (Joint& joint : model.joints) {
      joint.damping = random.uniform(0, 2);
      joint.friction = random.uniform(0, 2);
      joint.stiffness = random.uniform(0, 20);
      joint.neutral = random.uniform(-1, 1);
      joint.rotor_inertia = random.uniform(0, 1);
    }
    const State s = random_state(model, random);
    if (s.v.size() == 0) continue;
    check(model, Reference(model), arboc::State{s.q, s.v, s.a, s.tau});
    if (testing::Test::HasFailure()) return;
  }
}

/// Largest difference relative to the largest entry of `expected` (at least 1).
template <class A, class B>
double distance(const Eigen::MatrixBase<A>& actual, const Eigen::MatrixBase<B>& expected) {
  const Eigen::MatrixXd difference = actual - expected;
  if (difference.size() == 0) return 0;
  if (!difference.allFinite()) return std::numeric_limits<double>::infinity();
  return difference.cwiseAbs().maxCoeff() / std::max(1.0, expected.cwiseAbs().maxCoeff());
}

/// f'(0) of a vector or matrix by a central stencil of six points.
template <class F>
Eigen::MatrixXd stencil(const F& f, double h) {
  const auto odd = [&](int k) -> Eigen::MatrixXd { return f(k * h) - f(-k * h); };
  return (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h);
}

/// The state after the time t, by the second-order motion through it.
inline arboc::State after(const Reference& reference, const arboc::State& s, double t) {
  return {reference.integrate(s.q, t * s.v + 0.5 * t * t * s.a), s.v + t * s.a, s.a, s.tau};
}

}  // namespace arboc::test

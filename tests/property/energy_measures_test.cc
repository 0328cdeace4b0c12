// The kinetic energy of segments, and its exchange, on moving models without gravity.
#include <gtest/gtest.h>

#include "arboc/measures/energy.hpp"
#include "reference/frames.h"
#include "support/each_model.h"

namespace arboc::test {
namespace {

using Eigen::VectorXd;

Model weightless(Model model) {
  model.gravity = {0, 0, 0};
  return model;
}

/// TKE + RKE of every segment, from the motion of its frame.
double segments(const Reference& r, const VectorXd& q, const VectorXd& v) {
  double sum = 0;
  for (int i = 1; i <= r.nb(); ++i) {
    const auto& body = r.bodies()[static_cast<size_t>(i)];
    if (body.m == 0) continue;
    const spatial6::Vector6<double> motion = frame_velocity(r, q, v, i - 1, Axes::kLocal);
    const Eigen::Vector3d w = motion.tail<3>();
    const Eigen::Matrix3d cx = spatial6::skew(body.c);
    const Eigen::Matrix3d Ic = body.I.topLeftCorner<3, 3>() - body.m * cx * cx.transpose();
    const SegmentEnergy e = segment_energy(body.m, motion.head<3>() - cx * w, Ic, w);
    sum += e.translational + e.rotational;
  }
  return sum;
}

TEST(EnergyMeasures, SegmentsHaveTheEnergyOfTheMassMatrix) {
  for_each_model(40, [](const Model&, const Reference& r, const arboc::State& s) {
    const double quadratic = s.v.dot(r.crba(s.q) * s.v) / 2;
    EXPECT_NEAR(segments(r, s.q, s.v), quadratic, 1e-12 * std::max(1.0, quadratic));
  });
}

/// dE/dt = sum tau v - sum damping v^2.
TEST(EnergyMeasures, PowerBalances) {
  for_each_model(40, [](const Model& model, const Reference&, const arboc::State& s) {
    const JointForces damped{.damping = true};
    const Reference r(weightless(model), damped);
    const ComplexReference c(weightless(model), damped);
    const VectorXd a = r.aba(s.q, s.v, s.tau);
    const Complex step(0, 1e-30);
    const VectorOf<Complex> q = c.integrate(s.q.cast<Complex>(), step * s.v.cast<Complex>());
    const VectorOf<Complex> v = s.v.cast<Complex>() + step * a.cast<Complex>();
    const double rate = c.kinetic(q, v).imag() / 1e-30;
    const double lost = s.v.dot(r.nle(s.q, s.v) - Reference(weightless(model)).nle(s.q, s.v));
    EXPECT_NEAR(rate, s.tau.dot(s.v) - lost, 1e-9 * std::max(1.0, std::fabs(rate)));
  });
}

/// Runge and Kutta's steps of fourth order, on joints whose rates are derivatives of coordinates.
arboc::State advanced(const Reference& r, const arboc::State& s, double h) {
  const auto slope = [&](const VectorXd& q, const VectorXd& v) { return r.aba(q, v, s.tau); };
  const VectorXd a1 = slope(s.q, s.v), v2 = s.v + h / 2 * a1;
  const VectorXd a2 = slope(s.q + h / 2 * s.v, v2), v3 = s.v + h / 2 * a2;
  const VectorXd a3 = slope(s.q + h / 2 * v2, v3), v4 = s.v + h * a3;
  const VectorXd a4 = slope(s.q + h * v3, v4);
  return {s.q + h / 6 * (s.v + 2 * v2 + 2 * v3 + v4),
          s.v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4),
          {},
          s.tau};
}

TEST(EnergyMeasures, WithoutForcesNothingIsExchanged) {
  RandomModelOptions options;
  options.joints = 4;
  options.floating = options.planar = options.mimic = false;
  for (const auto seed : seeds(4)) {
    const Model model = weightless(random_model(seed, options));
    const Reference r(model);
    Random random(seed);
    const State start = random_state(model, random);
    if (start.v.size() == 0) continue;
    // Slow enough for the error of the steps, h^4 times fifth derivatives, to vanish.
    arboc::State s{start.q, start.v / 2, {}, VectorXd::Zero(start.v.size())};
    constexpr int kSteps = 400;
    VectorXd energies(kSteps + 1);
    for (int n = 0; n <= kSteps; ++n) {
      energies[n] = segments(r, s.q, s.v);
      s = advanced(r, s, 5e-4);
    }
    EXPECT_LE(exchange(energies), 1e-10 * std::max(1.0, energies[0])) << seed;
    EXPECT_NEAR(energies[kSteps], energies[0], 1e-10 * std::max(1.0, energies[0])) << seed;
    EXPECT_GT((s.q - start.q).norm(), 1e-2) << seed;
  }
}

}  // namespace
}  // namespace arboc::test

// Motions from rest to rest: the closed forms of [Astronaut], joins, limits, errors.
#include "arboc/motion/point_to_point.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "arboc/motion/quadrature.hpp"
#include "support/random.h"

namespace arboc::test {
namespace {

using Eigen::VectorXd;

/// Each derivative against six-point differences of the one before, where no join is near.
void expect_derivatives(const MotionFunction& f, double t, double h) {
  const auto slope = [&](double MotionSample::*x) {
    const auto odd = [&](int m) { return f(t + m * h).*x - f(t - m * h).*x; };
    return (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h);
  };
  const double speed = std::fabs(f.peak_velocity()), ramp = f.ramp_time();
  // Rounding of the differences over h; of degree 5, so exact otherwise.
  const double noise = 1e-13 * (1 + speed * f.duration());
  EXPECT_NEAR(slope(&MotionSample::position), f(t).velocity, noise / h);
  EXPECT_NEAR(slope(&MotionSample::velocity), f(t).acceleration, noise / h * (1 + speed));
  EXPECT_NEAR(slope(&MotionSample::acceleration), f(t).jerk, noise / h * (1 + 8 * speed / ramp));
}

TEST(Quintic, HasTheValuesOfItsFormula) {
  const auto f = MotionFunction::quintic({0, 1, 0, 1});
  EXPECT_DOUBLE_EQ(f(0.5).position, 0.5);
  EXPECT_EQ(f(0.5).velocity, 15.0 / 8);
  EXPECT_EQ(f.peak_velocity(), 15.0 / 8);
  for (const double t : {0.0, 1.0}) {
    EXPECT_EQ(f(t).position, t);
    EXPECT_EQ(f(t).velocity, 0);
    EXPECT_EQ(f(t).acceleration, 0);
  }
  // (1), its derivatives and 60 X/T^3 (1 - 6 s + 6 s^2).
  for (const auto seed : seeds(200)) {
    Random random(seed);
    const double from = random.uniform(-2, 2), X = random.uniform(-3, 3);
    const double t0 = random.uniform(-5, 5), T = random.uniform(0.2, 4);
    const auto g = MotionFunction::quintic({from, from + X, t0, T});
    const double s = random.uniform(0, 1);
    const MotionSample x = g(t0 + s * T);
    const double scale = 1e-14 * (1 + std::fabs(X)) * 64;
    EXPECT_NEAR(x.position, from + X * s * s * s * (10 - 15 * s + 6 * s * s), scale);
    EXPECT_NEAR(x.velocity, 30 * X / T * s * s * (1 - s) * (1 - s), scale / T);
    EXPECT_NEAR(x.acceleration, 60 * X / (T * T) * s * (1 - 3 * s + 2 * s * s), scale / (T * T));
    EXPECT_NEAR(x.jerk, 60 * X / (T * T * T) * (1 - 6 * s + 6 * s * s),
                8 * scale / (T * T * T) * (1 + std::fabs(t0)));
  }
}

TEST(ThreePhases, HaveTheTimesOfTheirFormulas) {
  const auto f = MotionFunction::limited({0, 1, 0, 1}, 1.5);
  EXPECT_NEAR(f.ramp_time(), 0.357142857142857, 1e-15);
  EXPECT_NEAR(f.cruise_time(), 0.285714285714286, 1e-15);
  EXPECT_NEAR(f.peak_velocity(), 1.5, 1e-15);
  const auto limit = MotionFunction::limited({0, 1, 0, 1}, 15.0 / 8);
  EXPECT_EQ(limit.cruise_time(), 0);
  // Just below the switch the motion is the quintic's, but for what the limit takes.
  const auto nearly = MotionFunction::limited({0, 1, 0, 1}, 15.0 / 8 * (1 - 1e-9));
  EXPECT_GT(nearly.cruise_time(), 0);
  EXPECT_LT(nearly.cruise_time(), 1e-8);
  const auto quintic = MotionFunction::quintic({0, 1, 0, 1});
  for (int n = 0; n <= 100; ++n)
    EXPECT_NEAR(nearly(n / 100.0).position, quintic(n / 100.0).position, 1e-8);
  // A limit that is never reached changes nothing.
  EXPECT_EQ(MotionFunction::limited({0, 1, 0, 1}, 7)(0.3).position, quintic(0.3).position);
}

TEST(ThreePhases, AreContinuousBoundedAndCoverTheDistance) {
  for (const auto seed : seeds(200)) {
    Random random(seed);
    const double from = random.uniform(-2, 2), X = random.uniform(0.2, 3);
    const double t0 = random.uniform(-5, 5), T = random.uniform(0.3, 3);
    const double V = X / T * random.uniform(1.02, 2), sign = random.chance(0.5) ? 1 : -1;
    const auto f = MotionFunction::limited({from, from + sign * X, t0, T}, V);
    const double a = t0 + f.ramp_time(), b = a + f.cruise_time();
    for (const double join : {t0, a, b, t0 + T}) {
      const double h = 1e-12;
      const MotionSample left = f(join - h), right = f(join + h);
      const double peak = V / f.ramp_time();
      EXPECT_NEAR(left.position, right.position, 1e-10 * V) << seed;
      EXPECT_NEAR(left.velocity, right.velocity, 1e-10 * peak) << seed;
      EXPECT_NEAR(left.acceleration, right.acceleration, 1e-10 * peak / f.ramp_time()) << seed;
    }
    EXPECT_NEAR(f(t0 + T).position, from + sign * X, 1e-14) << seed;
    EXPECT_EQ(f(t0 - 1).position, from);
    EXPECT_EQ(f(t0 + T + 1).velocity, 0);
    double fastest = 0;
    for (int n = 0; n <= 200; ++n)
      fastest = std::max(fastest, std::fabs(f(t0 + T * n / 200).velocity));
    EXPECT_LE(fastest, V * (1 + 1e-14)) << seed;
    EXPECT_NEAR(std::fabs(f.peak_velocity()), std::min(V, 15 * X / (8 * T)), 1e-14 * V) << seed;
    const double h = 1e-3 * f.ramp_time();
    expect_derivatives(f, t0 + f.ramp_time() * random.uniform(0.01, 0.99), h);
    expect_derivatives(f, t0 + T - f.ramp_time() * random.uniform(0.01, 0.99), h);
    // The distance is the integral of the velocity.
    const Quadrature up = span_quadrature(BSplineBasis(0, {t0, a}), 3);
    double distance = f.peak_velocity() * f.cruise_time();
    for (int n = 0; n < 3; ++n) distance += 2 * up.weights[n] * f(up.instants[n]).velocity;
    EXPECT_NEAR(distance, sign * X, 1e-13 * X * 10) << seed;
  }
}

TEST(ThreePhases, SayWhenThereIsNone) {
  const auto minimum = [](double X, double T, double V) {
    try {
      MotionFunction::limited({0, X, 0, T}, V);
    } catch (const NoSuchMotion& none) {
      return none.minimum_time;
    }
    return -1.0;
  };
  EXPECT_EQ(minimum(1, 1, 1), 1);
  EXPECT_EQ(minimum(-3, 1, 2), 1.5);
  EXPECT_EQ(minimum(1, 1, 0), HUGE_VAL);
  EXPECT_EQ(minimum(1, 1, -2), HUGE_VAL);
  EXPECT_EQ(minimum(1, 1, std::nan("")), HUGE_VAL);
  EXPECT_EQ(minimum(1, 1.0000001, 1), -1);  // hardly more than the minimum exists
  EXPECT_EQ(minimum(0, 1, 0), -1);          // standing still needs no speed
  try {
    MotionFunction::limited({0, -3, 0, 1}, 2);
    FAIL();
  } catch (const std::domain_error& none) {
    EXPECT_STREQ(
        none.what(),
        "no such motion: 3 in 1 s at no more than 2 per s; minimum time is 1.5 s, which it "
        "must exceed");
  }
  EXPECT_THROW(MotionFunction::quintic({0, 1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(MotionFunction::quintic({0, 1, 0, -1}), std::invalid_argument);
  EXPECT_THROW(MotionFunction::limited({0, 1, 0, 0}, 1), std::invalid_argument);
  EXPECT_THROW(MotionFunction::quintic({std::nan(""), 1, 0, 1}), std::invalid_argument);
}

TEST(MotionPath, MovesAlongALine) {
  const Eigen::Vector3d from(1, 2, 3), to(1, 5, 7);
  const auto f = MotionPath::along_line({from, to, 2, 4}, 1.5);
  for (int n = -1; n <= 41; ++n) {
    const auto x = f(2 + 0.1 * n);
    EXPECT_LE(x.velocity.norm(), 1.5 * (1 + 1e-14));
    EXPECT_NEAR(Eigen::Vector3d(x.position - from).cross(to - from).norm(), 0, 1e-14);
    EXPECT_NEAR(Eigen::Vector3d(x.acceleration).cross(to - from).norm(), 0, 1e-13);
  }
  EXPECT_NEAR(f(4).velocity.norm(), 1.5, 1e-14);
  EXPECT_EQ(f(2).position, VectorXd(from));
  EXPECT_EQ(f(6).position, VectorXd(to));
  try {
    MotionPath::along_line({from, to, 2, 2}, 2);
    FAIL();
  } catch (const NoSuchMotion& none) {
    EXPECT_EQ(none.minimum_time, 2.5);  // 5 m
  }
}

TEST(MotionPath, MovesEachCoordinateUnderItsLimit) {
  const Eigen::Vector3d from(0, 1, 2), to(1, -1, 2), limits(1.2, 100, 0);
  const auto f = MotionPath::by_coordinate({from, to, 0, 1}, limits);
  const auto quintic = MotionPath::quintic({from, to, 0, 1});
  for (int n = 0; n <= 20; ++n) {
    const double t = n / 20.0;
    const auto x = f(t), y = quintic(t);
    EXPECT_LE(std::fabs(x.velocity[0]), 1.2 * (1 + 1e-14));
    EXPECT_EQ(x.position[1], y.position[1]);
    EXPECT_EQ(x.position[2], 2);
    for (int i = 0; i < 3; ++i) {
      const auto one = MotionFunction::quintic({from[i], to[i], 0, 1})(t);
      EXPECT_EQ(y.position[i], one.position);
      EXPECT_EQ(y.velocity[i], one.velocity);
      EXPECT_EQ(y.acceleration[i], one.acceleration);
      EXPECT_EQ(y.jerk[i], one.jerk);
    }
  }
  // The complaint names the time that all coordinates need.
  try {
    MotionPath::by_coordinate({from, to, 0, 1}, Eigen::Vector3d(0.5, 0.4, 1));
    FAIL();
  } catch (const NoSuchMotion& none) {
    EXPECT_EQ(none.minimum_time, 5);
  }
  EXPECT_THROW(MotionPath::by_coordinate({from, to, 0, 1}, VectorXd::Ones(2)),
               std::invalid_argument);
  EXPECT_THROW(MotionPath::quintic({from, VectorXd::Ones(2), 0, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace arboc::test

// Energy expenditure and normalised torques: cases of sign, bounds, derivatives by complex step.
#include <gtest/gtest.h>

#include <complex>
#include <type_traits>

#include "arboc/measures/energy.hpp"
#include "arboc/measures/torque.hpp"
#include "arboc/motion/basis_matrix.hpp"
#include "arboc/motion/point_to_point.hpp"
#include "support/random.h"

namespace arboc::test {
namespace {

using Complex = std::complex<double>;
using Eigen::VectorXd;

constexpr double kStep = 1e-30;

VectorXd list(std::initializer_list<double> x) {
  return Eigen::Map<const VectorXd>(x.begin(), static_cast<Eigen::Index>(x.size()));
}

TEST(Energy, CountsNegativeWorkAThird) {
  EXPECT_EQ(joint_effort(3, -1), 1);
  EXPECT_EQ(joint_effort(-3, 1), 1);
  EXPECT_EQ(joint_effort(3, 0), 3);  // the boundary is positive work
  EXPECT_EQ(joint_effort(-3, 0), 3);
  EXPECT_EQ(joint_effort(-3, -1), 3);
  EXPECT_EQ(effort(list({3, 3, -2}), list({-1, 0, -5})), 1 + 3 + 2);
  EXPECT_EQ(effort(list({3, 3, -2}), list({-1, 0, -5}), list({2, 0, 0.5})), 2 + 0 + 1);
  EXPECT_EQ(power_transfer(3, 2), 6);
  EXPECT_EQ(power_transfer(-3, -2), 6);
  EXPECT_EQ(power_transfer(3, -2), 2);
  EXPECT_EQ(power_transfer(-3, 2), 2);
  EXPECT_EQ(power_transfer(3, 0), 0);
  EXPECT_EQ(transfer(list({3, 3}), list({2, -2})), 8);
  EXPECT_THROW(effort(list({1}), list({1, 2})), std::invalid_argument);
  EXPECT_THROW(effort(list({1}), list({1}), list({1, 2})), std::invalid_argument);
  EXPECT_THROW(power(list({1}), list({1, 2})), std::invalid_argument);
}

TEST(Energy, PowerIsOfTheJointsOwnRate) {
  // Segments that turn together: joint 2 is locked and takes none, whatever its torque.
  const VectorXd segment = list({0.7, 0.7, -0.1});
  const VectorXd rate = list({0.7, segment[1] - segment[0], segment[2] - segment[1]});
  EXPECT_EQ(joint_power(50, rate[1]), 0);
  EXPECT_DOUBLE_EQ(power(list({2, 50, -1}), rate), 1.4 + 0.8);
}

TEST(Energy, ExchangeAddsUpRiseAndFall) {
  EXPECT_EQ(exchange(list({1, 3, 2, 2, 5})), 2 + 1 + 0 + 3);
  EXPECT_EQ(exchange(list({4})), 0);
  EXPECT_EQ(exchange(VectorXd()), 0);
  const Eigen::Vector3d v(1, 2, 2), w(0, 0, 3);
  const SegmentEnergy e = segment_energy(2, v, Eigen::Vector3d(1, 2, 4).asDiagonal(), w);
  EXPECT_EQ(e.translational, 9);
  EXPECT_EQ(e.rotational, 18);
}

TEST(Energy, JerkOfTheQuintic) {
  // The integral of |60 (1 - 6 s + 6 s^2)| is 40 / sqrt(3) (zeros at 1/2 +- 1/sqrt(12)), times
  // X/T^2.
  const double X = 2, T = 3;
  const auto f = MotionFunction::quintic({0, X, 1, T});
  const double a = 0.5 - 1 / std::sqrt(12), b = 1 - a;
  const auto rule = span_quadrature(BSplineBasis(0, {1, 1 + a * T, 1 + b * T, 1 + T}), 2);
  double sum = 0;
  for (Eigen::Index n = 0; n < rule.instants.size(); ++n)
    sum += rule.weights[n] * jerk(VectorXd::Constant(1, f(rule.instants[n]).jerk));
  EXPECT_NEAR(sum, 40 / std::sqrt(3.0) * X / (T * T), 1e-13);
}

TEST(Energy, SaysWhatTheJerkOfASplineIs) {
  EXPECT_STREQ(jerk_warning(BSplineBasis::clamped_uniform(2, 8, 0, 1)),
               "the jerk of B-splines below degree 3 is zero between their knots");
  EXPECT_STREQ(
      jerk_warning(BSplineBasis::clamped_uniform(3, 8, 0, 1)),
      "the jerk of these B-splines jumps at their knots (degree 4 and simple knots make it "
      "continuous)");
  EXPECT_EQ(jerk_warning(BSplineBasis::clamped_uniform(4, 8, 0, 1)), nullptr);
  EXPECT_EQ(jerk_warning(BSplineBasis::clamped_uniform(3, 4, 0, 1)), nullptr);  // no knots inside
}

/// All derivatives of a smooth measure against complex steps of the one below.
template <class F>
void expect_jet(F&& f, double tau, double w) {
  const auto at = f(tau, w);
  const auto along_tau = f(Complex(tau, kStep), Complex(w, 0));
  const auto along_w = f(Complex(tau, 0), Complex(w, kStep));
  // Some dozen roundings of terms up to 1/e that partly cancel.
  const auto near = [](double value, const Complex& step, double scale) {
    EXPECT_NEAR(value, step.imag() / kStep, 1e-12 * (1 + scale));
  };
  const double first = std::fabs(at.d_tau) + std::fabs(at.d_w);
  const double second = std::fabs(at.d_tau_tau) + std::fabs(at.d_tau_w) + std::fabs(at.d_w_w);
  near(at.d_tau, along_tau.value, first);
  near(at.d_w, along_w.value, first);
  near(at.d_tau_tau, along_tau.d_tau, second);
  near(at.d_tau_w, along_w.d_tau, second);
  near(at.d_tau_w, along_tau.d_w, second);
  near(at.d_w_w, along_w.d_w, second);
}

const auto kEffort = [](auto tau, auto w) { return smooth_joint_effort(tau, w); };
const auto kPower = [](auto tau, auto w) { return smooth_joint_power(tau, w); };
const auto kTransfer = [](auto tau, auto w) { return smooth_power_transfer(tau, w); };

TEST(Energy, SmoothVersionsHaveTheirDerivatives) {
  Random random(1);
  for (int n = 0; n < 500; ++n) {
    const double size = std::pow(10, random.uniform(-4, 2));
    const double tau = random.uniform(-size, size), w = random.uniform(-2, 2);
    expect_jet(kEffort, tau, w);
    expect_jet(kPower, tau, w);
    expect_jet(kTransfer, tau, w);
    const Jet1<Complex> step = smooth_jerk(Complex(tau, kStep));
    EXPECT_NEAR(smooth_jerk(tau).d, step.value.imag() / kStep, 1e-14);
    EXPECT_NEAR(smooth_jerk(tau).dd, step.d.imag() / kStep, 1e-12);
  }
  for (const double x : {0.0, 1.0}) {
    expect_jet(kEffort, x, 0);
    expect_jet(kEffort, 0, x);
    expect_jet(kTransfer, 0, x);
  }
}

TEST(Energy, SmoothVersionsTendToTheExactOnes) {
  Random random(2);
  Smoothing fine;
  fine.torque = fine.power = fine.jerk = 1e-7;
  for (int n = 0; n < 500; ++n) {
    const double tau = random.uniform(-50, 50), w = random.uniform(-2, 2);
    if (std::fabs(tau * w) < 1e-2) continue;
    EXPECT_NEAR(smooth_joint_effort(tau, w, fine).value, joint_effort(tau, w), 1e-6);
    EXPECT_NEAR(smooth_joint_power(tau, w, fine).value, joint_power(tau, w), 1e-7);
    EXPECT_NEAR(smooth_power_transfer(tau, w, fine).value, power_transfer(tau, w), 1e-7);
    EXPECT_GE(smooth_power_transfer(tau, w).value, power_transfer(tau, w));
    EXPECT_LE(smooth_power_transfer(tau, w).value, power_transfer(tau, w) + 2.0 / 3 * 1e-2);
  }
}

TEST(Energy, SumsOverJoints) {
  const VectorXd tau = list({3, -2, 0.1}), w = list({1, 0.5, -1}), c = list({1, 2, 3});
  const SmoothMeasure sum = sum_over_joints(tau, w, kEffort, c);
  double value = 0;
  for (int i = 0; i < 3; ++i) {
    const auto one = smooth_joint_effort(tau[i], w[i]);
    value += c[i] * one.value;
    EXPECT_EQ(sum.d_tau[i], c[i] * one.d_tau);
    EXPECT_EQ(sum.d_w[i], c[i] * one.d_w);
    EXPECT_EQ(sum.d_tau_tau[i], c[i] * one.d_tau_tau);
    EXPECT_EQ(sum.d_tau_w[i], c[i] * one.d_tau_w);
    EXPECT_EQ(sum.d_w_w[i], c[i] * one.d_w_w);
  }
  EXPECT_DOUBLE_EQ(sum.value, value);
  EXPECT_THROW(sum_over_joints(tau, list({1}), kEffort), std::invalid_argument);
}

TEST(NormalisedTorque, IsOneAtEitherLimitAndItsSquareIsSmooth) {
  // The joint of [Thesis] figure 5.4: -3 and 10 N m.
  EXPECT_EQ(normalised_torque(10, -3, 10), 1);
  EXPECT_EQ(normalised_torque(-3, -3, 10), 1);
  EXPECT_EQ(normalised_torque(0, -3, 10), 0);
  EXPECT_EQ(normalised_torque(5, -3, 10), 0.5);
  const double h = 1e-9;
  EXPECT_NEAR(normalised_torque(h, -3, 10) / h, 0.1, 1e-15);  // the kink
  EXPECT_NEAR(normalised_torque(-h, -3, 10) / -h, -1 / 3.0, 1e-15);
  EXPECT_EQ(normalised_torque_squared(0, -3, 10).d, 0);
  EXPECT_NEAR(normalised_torque_squared(h, -3, 10).d, 0, 1e-8);
  EXPECT_NEAR(normalised_torque_squared(-h, -3, 10).d, 0, 1e-8);
  for (const double tau : {-7.0, -0.5, 0.5, 4.0}) {
    const double limit = tau < 0 ? -3 : 10;
    const Complex x(tau, kStep), n = x / limit;
    EXPECT_NEAR(normalised_torque_squared(tau, -3, 10).d, (n * n).imag() / kStep, 1e-14);
    EXPECT_EQ(normalised_torque_squared(tau, -3, 10).dd, 2 / (limit * limit));
  }
  const TorqueLimits limits(list({-3, -HUGE_VAL}), list({10, HUGE_VAL}));
  EXPECT_EQ(normalised_torque(list({-1.5, 1e9}), limits), list({0.5, 0}));
  EXPECT_THROW(TorqueLimits(list({0}), list({1})), std::invalid_argument);
  EXPECT_THROW(TorqueLimits(list({-1}), list({std::nan("")})), std::invalid_argument);
  EXPECT_THROW(TorqueLimits(list({-1}), list({1, 2})), std::invalid_argument);
  EXPECT_THROW(normalised_torque(list({1}), limits), std::invalid_argument);
}

/// (5.7) as it is printed, which is fine while nothing overflows.
template <class T>
T printed_norm(const Eigen::Matrix<T, Eigen::Dynamic, 1>& tau, const TorqueLimits& limits,
               double p) {
  T sum(0);
  for (Eigen::Index i = 0; i < tau.size(); ++i) {
    const T n = tau[i] / limits.towards(std::real(tau[i]), i);
    sum += std::pow(n * n + 1.0, p);
  }
  return std::pow(sum, 1 / p);
}

TEST(NormalisedTorque, NormHasItsDerivatives) {
  for (const auto seed : seeds(30)) {
    Random random(seed);
    const int m = 1 + random.integer(8);
    const TorqueLimits limits(-VectorXd::Constant(m, 5) + random.vector(m, 4),
                              VectorXd::Constant(m, 8) + random.vector(m, 6));
    const VectorXd tau = random.vector(m, 8);
    for (const double p : {1.0, 2.0, 7.5, 100.0}) {
      const TorqueMeasure norm = normalised_torque_norm(tau, limits, p);
      EXPECT_NEAR(norm.value, printed_norm<double>(tau, limits, p), 1e-13 * norm.value);
      const Eigen::MatrixXd H = norm.hessian();
      for (int i = 0; i < m; ++i) {
        Eigen::VectorXcd moved = tau.cast<Complex>();
        moved[i] += Complex(0, kStep);
        // Powers of p multiply relative errors by p.
        EXPECT_NEAR(norm.gradient[i], printed_norm<Complex>(moved, limits, p).imag() / kStep,
                    1e-13 * p * (1 + norm.gradient.cwiseAbs().maxCoeff()));
        const double h = 1e-5;
        for (int j = 0; j < m; ++j) {
          const auto slope = [&](double step) {
            VectorXd at = tau;
            at[i] += step;
            return normalised_torque_norm(at, limits, p).gradient[j];
          };
          const auto odd = [&](int k) { return slope(k * h) - slope(-k * h); };
          if (std::fabs(tau[i]) < 4 * h) continue;  // where the second derivative jumps
          EXPECT_NEAR(H(j, i), (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h),
                      1e-9 * p * (1 + H.cwiseAbs().maxCoeff()));
        }
      }
    }
  }
}

TEST(NormalisedTorque, NormLiesBetweenItsBounds) {
  for (const auto seed : seeds(100)) {
    Random random(seed);
    const int m = 1 + random.integer(60);
    const TorqueLimits limits(VectorXd::Constant(m, -4), VectorXd::Constant(m, 9));
    const VectorXd tau = random.vector(m, 10);
    const double most = normalised_torque(tau, limits).maxCoeff(), least = 1 + most * most;
    for (const double p : {1.0, 100.0, 1e4, 1e9}) {
      const TorqueMeasure norm = normalised_torque_norm(tau, limits, p);
      EXPECT_GE(norm.value, least * (1 - 1e-15));
      EXPECT_LE(norm.value, least * std::pow(m, 1 / p) * (1 + 1e-14));
      EXPECT_TRUE(norm.gradient.allFinite() && norm.hessian().allFinite());
    }
  }
}

TEST(NormalisedTorque, NormSurvivesWhatOverflowsAsPrinted) {
  const TorqueLimits limits(list({-1, -1}), list({1, 1}));
  const VectorXd tau = list({1e4, 3});
  EXPECT_EQ(printed_norm<double>(tau, limits, 100), HUGE_VAL);
  const TorqueMeasure norm = normalised_torque_norm(tau, limits, 100);
  EXPECT_DOUBLE_EQ(norm.value, 1e8 + 1);
  EXPECT_DOUBLE_EQ(norm.gradient[0], 2e4);
  EXPECT_EQ(norm.gradient[1], 0);
  // All at rest: m terms of 1; the value printed for motions without torque, (6.4).
  EXPECT_NEAR(normalised_torque_norm(VectorXd::Zero(24), limits.at_instants(12)).value,
              std::pow(24, 0.01), 1e-14);
  EXPECT_THROW(normalised_torque_norm(tau, limits, 0.5), std::invalid_argument);
  EXPECT_THROW(normalised_torque_norm(tau, limits, HUGE_VAL), std::invalid_argument);
  EXPECT_THROW(normalised_torque_norm(list({1}), limits), std::invalid_argument);
  EXPECT_EQ(normalised_torque_norm(VectorXd(), TorqueLimits(VectorXd(), VectorXd())).value, 0);
}

TEST(NormalisedTorque, FitsThePublishedValues) {
  // [Thesis] table 5.2 and 5.3: six joints, largest normalised torque and objective 4 at its
  // optimum.
  struct Row {
    double most, objective;
  };
  for (const Row& row : {Row{0.281, 1.09}, Row{0.345, 1.13}, Row{0.190, 1.05}, Row{0.810, 1.67}}) {
    const double least = 1 + row.most * row.most;
    EXPECT_LE(least, row.objective + 0.006) << "rounded to two digits";
    EXPECT_GE(least * std::pow(6, 0.01), row.objective - 0.006);
  }
}

TEST(NormalisedTorque, SumIsOfSquares) {
  const TorqueLimits limits(list({-2, -4}), list({5, 8}));
  const TorqueMeasure sum = normalised_torque_sum(list({1, -1}), limits);
  EXPECT_DOUBLE_EQ(sum.value, 1 / 25.0 + 1 / 16.0);
  EXPECT_DOUBLE_EQ(sum.gradient[0], 2 / 25.0);
  EXPECT_DOUBLE_EQ(sum.gradient[1], -2 / 16.0);
  EXPECT_DOUBLE_EQ(sum.hessian()(1, 1), 2 / 16.0);
  EXPECT_EQ(sum.hessian()(0, 1), 0);
}

}  // namespace
}  // namespace arboc::test

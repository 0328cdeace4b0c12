// Compiled code against the laws of mechanics: nothing here asks another engine for a result.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "support/engines.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The functions of one model, with Eigen's types.
class Code {
 public:
  explicit Code(const Model& model)
      : code_(generated_code(model, functions_of(model), "-std=c++17 -O1 -march=native")) {}

  VectorXd vector(const std::string& function, const State& state, int* status = nullptr) const {
    const Values results = code_.call(function, inputs_of(state), status);
    return vector_of(results.begin()->second);
  }
  MatrixXd matrix(const std::string& function, const State& state, Eigen::Index rows) const {
    return vector(function, state).reshaped<Eigen::RowMajor>(rows, Eigen::AutoSize);
  }

 private:
  cli::GeneratedCode code_;
};

double largest(const MatrixXd& A) { return A.cwiseAbs().maxCoeff(); }

void expect_inertia(const Code& code, const State& state) {
  const Eigen::Index n = state.v.size();
  const MatrixXd M = code.matrix("crba", state, n), Minv = code.matrix("minv", state, n);
  EXPECT_EQ(M, M.transpose());
  EXPECT_EQ(Minv, Minv.transpose());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues()[0], 0);
  const double rounding = 1e-14 * condition(M);
  EXPECT_LE(largest(M * Minv - MatrixXd::Identity(n, n)), rounding);

  State driven = state;
  driven.tau = code.vector("rnea", state);
  EXPECT_LE(largest(code.vector("aba", driven) - state.a), rounding * largest(driven.tau));
  const VectorXd nle = code.vector("nle", state);
  EXPECT_LE(largest(driven.tau - M * state.a - nle), 1e-13 * (1 + largest(driven.tau)));
}

/// d/dt (v M v / 2) = v (tau - g) along q(t) = q (+) (v t + a t^2 / 2).
void expect_energy_balance(const Code& code, const Reference& reference, const State& state) {
  const auto kinetic = [&](double t) {
    State at = state;
    at.q = reference.integrate(state.q, t * state.v + 0.5 * t * t * state.a);
    const VectorXd v = state.v + t * state.a;
    return 0.5 * v.dot(code.matrix("crba", at, v.size()) * v);
  };
  constexpr double h = 1e-4;  // truncation h^4, rounding eps/h: 1e-12
  const double rate =
      (8 * (kinetic(h) - kinetic(-h)) - kinetic(2 * h) + kinetic(-2 * h)) / (12 * h);
  const VectorXd force = code.vector("rnea", state) - code.vector("gravity", state);
  const double size = state.v.cwiseAbs().dot(force.cwiseAbs()) + kinetic(0);
  EXPECT_NEAR(rate, state.v.dot(force), 1e-9 * size);
}

void expect_rotations(const Code& code, const State& state) {
  const VectorXd placements = code.vector("fk", state);
  for (Eigen::Index k = 0; k < placements.size(); k += 12) {
    const Eigen::Matrix3d R = placements.segment<9>(k).reshaped<Eigen::RowMajor>(3, 3);
    EXPECT_LE(largest(R * R.transpose() - Eigen::Matrix3d::Identity()), 1e-14);
    EXPECT_NEAR(R.determinant(), 1, 1e-14);
  }
}

void expect_nan_is_reported(const Code& code, State state) {
  state.q.setConstant(NAN);
  int status = 0;
  EXPECT_TRUE(code.vector("aba", state, &status).array().isNaN().all());
  EXPECT_GT(status, 0);
  EXPECT_LE(status, state.v.size());
  EXPECT_TRUE(code.vector("minv", state, &status).array().isNaN().any());
  EXPECT_GT(status, 0);
}

class GeneratedProperties : public testing::TestWithParam<const char*> {};

TEST_P(GeneratedProperties, Hold) {
  ModelOptions options;
  options.base = std::string(GetParam()) == "ur5" ? Base::kFixed : Base::kFloating;
  const Model model = own_model(GetParam(), options);
  const Code code(model);
  const Reference reference(model);
  Random random(17);
  for (int k = 0; k < 10; ++k) {
    SCOPED_TRACE(k);
    const State state = random_state(model, random);
    expect_inertia(code, state);
    expect_energy_balance(code, reference, state);
    expect_rotations(code, state);
    expect_nan_is_reported(code, state);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, GeneratedProperties,
                         testing::Values("ur5", "all_joints", "quadruped"),
                         [](const auto& name) { return std::string(name.param); });

/// models/double_pendulum/ORIGIN.md, closed form.
TEST(GeneratedDoublePendulum, HasItsClosedForm) {
  constexpr double m1 = 1.2, m2 = 0.6, l1 = 1, s1 = 0.5, s2 = 0.25, I1 = 0.10003, I2 = 0.012515,
                   g = 9.81;
  const Model model = own_model("double_pendulum");
  const Code code(model);
  Random random(19);
  for (int k = 0; k < 50; ++k) {
    State x = random_state(model, random);
    const double c = std::cos(x.q[1]), d = m2 * l1 * s2 * std::sin(x.q[1]);
    Eigen::Matrix2d M;
    M(0, 0) = I1 + m1 * s1 * s1 + I2 + m2 * (l1 * l1 + s2 * s2 + 2 * l1 * s2 * c);
    M(0, 1) = M(1, 0) = I2 + m2 * (s2 * s2 + l1 * s2 * c);
    M(1, 1) = I2 + m2 * s2 * s2;
    const double both = m2 * s2 * std::sin(x.q[0] + x.q[1]);
    const Eigen::Vector2d gravity(g * ((m1 * s1 + m2 * l1) * std::sin(x.q[0]) + both), g * both);
    const Eigen::Vector2d bias(-d * (2 * x.v[0] * x.v[1] + x.v[1] * x.v[1]), d * x.v[0] * x.v[0]);
    constexpr double kRounding = 1e-14;
    EXPECT_LE(largest(code.matrix("crba", x, 2) - M), kRounding);
    EXPECT_LE(largest(code.vector("gravity", x) - gravity), 10 * kRounding);
    EXPECT_LE(largest(code.vector("nle", x) - gravity - bias), 10 * kRounding);
    EXPECT_LE(largest(code.vector("rnea", x) - M * x.a - gravity - bias), 10 * kRounding);
    EXPECT_LE(largest(code.matrix("minv", x, 2) - M.inverse()), 1e-12);
    EXPECT_LE(largest(code.vector("aba", x) - M.inverse() * (x.tau - gravity - bias)), 1e-11);
  }
}

}  // namespace
}  // namespace arboc::test

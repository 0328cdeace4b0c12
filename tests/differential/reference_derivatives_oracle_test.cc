// Jacobians, momenta, the regressor and derivatives of the reference engine against Pinocchio's
// recorded results for fifteen public robots; read as in reference_oracle_test.cc.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <filesystem>

#include "frontend/urdf.h"
#include "reference/differentiate.h"
#include "reference/frames.h"
#include "reference/momentum.h"
#include "reference/regressor.h"
#include "support/oracle.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-12;     // of sums over a tree, relative to a row's largest entry
constexpr double kDifferences = 1e-10;  // of second derivatives, likewise

VectorXd by_rows(const MatrixXd& A) { return A.reshaped<Eigen::RowMajor>(); }

double condition(const MatrixXd& M) {
  const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues();
  return eigenvalues[eigenvalues.size() - 1] / eigenvalues[0];
}

const auto kRnea = [](const auto& r, const auto& x) { return r.rnea(x.q, x.v, x.a); };
const auto kAba = [](const auto& r, const auto& x) { return r.aba(x.q, x.v, x.tau); };

class ReferenceDerivativesOracle : public testing::TestWithParam<OracleRobot> {
 protected:
  void SetUp() override {
    const OracleRobot robot = GetParam();
    if (!std::filesystem::exists(oracle_urdf(robot)) || oracle(robot, "q").size() == 0)
      GTEST_SKIP() << "no recorded results for " << robot.name;
    ModelOptions options;
    options.base = robot.base;
    options.mimic = MimicPolicy::kIndependent;
    options.order = JointOrder::kAlphabetical;
    options.snap = 0;
    Diagnostics diagnostics;
    model_ = configure(read_urdf(oracle_urdf(robot), diagnostics), options, diagnostics);
    const MatrixXd q = oracle(robot, "qflat"), v = oracle(robot, "v"), a = oracle(robot, "a"),
                   tau = oracle(robot, "tau_in");
    for (int i = 0; i < q.rows(); ++i)
      states_.push_back({q.row(i), v.row(i), a.row(i), tau.row(i)});
  }

  /// Each row of the record against compute(state), within tolerance(state) of its largest entry.
  template <class Compute, class Tolerance>
  void compare(const std::string& quantity, const Compute& compute,
               const Tolerance& tolerance) const {
    const MatrixXd expected = oracle(GetParam(), quantity);
    ASSERT_EQ(expected.rows(), static_cast<Eigen::Index>(states_.size())) << quantity;
    double worst = 0;
    for (int i = 0; i < expected.rows(); ++i) {
      const VectorXd actual = compute(states_[i]);
      ASSERT_EQ(actual.size(), expected.cols()) << quantity;
      const double largest = expected.row(i).cwiseAbs().maxCoeff();
      const double error = (actual - expected.row(i).transpose()).cwiseAbs().maxCoeff();
      EXPECT_LE(error, tolerance(states_[i]) * largest) << quantity << ", state " << i;
      worst = std::max(worst, error / largest);
    }
    RecordProperty(quantity, std::to_string(-std::log10(worst + 1e-99)));
  }

  Model model_;
  std::vector<State> states_;
};

TEST_P(ReferenceDerivativesOracle, JacobiansMomentaAndRegressor) {
  const Reference r(model_);
  const auto rounding = [](const State&) { return kRounding; };
  compare(
      "J", [&](const State& x) { return by_rows(joint_jacobians(r, x.q)); }, rounding);
  compare(
      "Ag", [&](const State& x) { return by_rows(centroidal(r, x.q, x.v, x.a).A_G); }, rounding);
  compare(
      "regressor", [&](const State& x) { return by_rows(regressor(r, x.q, x.v, x.a)); }, rounding);
}

TEST_P(ReferenceDerivativesOracle, FirstDerivatives) {
  const Reference r(model_);
  const ComplexReference complex(model_);
  const auto rounding = [](const State&) { return kRounding; };
  const auto solving = [&](const State& x) {
    return kRounding * std::max(1.0, condition(r.crba(x.q)) / 1e4);
  };
  const auto derivative = [&](const auto& f, With with) {
    return [&, with](const State& x) { return by_rows(differentiate(complex, f, x, with)); };
  };
  compare("dtau_dq", derivative(kRnea, With::kQ), rounding);
  compare("dtau_dv", derivative(kRnea, With::kV), rounding);
  compare("M", derivative(kRnea, With::kA), rounding);
  compare("dqdd_dq", derivative(kAba, With::kQ), solving);
  compare("dqdd_dv", derivative(kAba, With::kV), solving);
  compare("Minv", derivative(kAba, With::kTau), solving);
}

/// Entry i + n j + n^2 k: of tau_i, along j, then k.
TEST_P(ReferenceDerivativesOracle, SecondDerivatives) {
  if (oracle(GetParam(), "d2tau_dqdq").size() == 0) GTEST_SKIP() << "none recorded";
  const ComplexReference complex(model_);
  const auto tolerance = [](const State&) { return kDifferences; };
  const auto tensor = [&](With first, With second) {
    return [&, first, second](const State& x) {
      const auto layers = differentiate_twice(complex, kRnea, x, first, second);
      const Eigen::Index n = complex.nv();
      VectorXd all(n * n * n);
      for (Eigen::Index k = 0; k < n; ++k) all.segment(k * n * n, n * n) = layers[k].reshaped();
      return all;
    };
  };
  compare("d2tau_dqdq", tensor(With::kQ, With::kQ), tolerance);
  compare("d2tau_dvdv", tensor(With::kV, With::kV), tolerance);
  compare("d2tau_dqdv", tensor(With::kQ, With::kV), tolerance);
  compare("d2tau_dadq", tensor(With::kA, With::kQ), tolerance);
}

INSTANTIATE_TEST_SUITE_P(Robots, ReferenceDerivativesOracle, testing::ValuesIn(oracle_robots()),
                         [](const auto& robot) { return std::string(robot.param.name); });

}  // namespace
}  // namespace arboc::test

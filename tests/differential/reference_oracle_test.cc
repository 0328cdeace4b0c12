// The reference engine against Pinocchio's recorded results for fifteen public robots.
//
// Pinocchio's model is ours read with joints in alphabetical order, mimic followers independent
// and no angle snapped; both then round differently, which is all the tolerances allow for.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <filesystem>

#include "frontend/urdf.h"
#include "reference/reference.h"
#include "support/oracle.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-12;  // of sums over a tree, relative to a row's largest entry

VectorXd flat(const MatrixXd& A) { return A.reshaped<Eigen::RowMajor>(); }

double condition(const MatrixXd& M) {
  const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues();
  return eigenvalues[eigenvalues.size() - 1] / eigenvalues[0];
}

class ReferenceOracle : public testing::TestWithParam<OracleRobot> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(oracle_urdf(GetParam())) || oracle(GetParam(), "q").size() == 0)
      GTEST_SKIP() << "no recorded results for " << GetParam().name;
    ModelOptions options;
    options.base = GetParam().base;
    options.mimic = MimicPolicy::kIndependent;
    options.order = JointOrder::kAlphabetical;
    options.snap = 0;
    Diagnostics diagnostics;
    model_ = configure(read_urdf(oracle_urdf(GetParam()), diagnostics), options, diagnostics);
  }

  /// Each row of the record `quantity` against compute(state), with rounding amplified by
  /// amplification(state).
  template <class Compute, class Amplification>
  void compare(const std::string& quantity, Compute compute, Amplification amplification) const {
    const MatrixXd expected = oracle(GetParam(), quantity);
    ASSERT_GT(expected.rows(), 0);
    for (int i = 0; i < expected.rows(); ++i) {
      const VectorXd actual = compute(i);
      ASSERT_EQ(actual.size(), expected.cols()) << quantity;
      const double largest = expected.row(i).cwiseAbs().maxCoeff();
      const double error = (actual - expected.row(i).transpose()).cwiseAbs().maxCoeff();
      EXPECT_LE(error, kRounding * amplification(i) * largest) << quantity << ", state " << i;
    }
  }

  Model model_;
};

TEST_P(ReferenceOracle, Agrees) {
  const Reference reference(model_);
  const auto rows = [&](const char* quantity) -> MatrixXd {
    return oracle(GetParam(), quantity).transpose();
  };
  const MatrixXd q = rows("qflat"), v = rows("v"), a = rows("a"), tau = rows("tau_in");
  ASSERT_EQ(reference.nq(), q.rows());
  ASSERT_EQ(reference.nv(), v.rows());

  const auto rounding = [](int) { return 1.0; };
  compare(
      "tau", [&](int i) { return reference.rnea(q.col(i), v.col(i), a.col(i)); }, rounding);
  compare(
      "nle", [&](int i) { return reference.nle(q.col(i), v.col(i)); }, rounding);
  compare(
      "grav", [&](int i) { return reference.gravity(q.col(i)); }, rounding);
  compare(
      "M", [&](int i) { return flat(reference.crba(q.col(i))); }, rounding);

  const auto solving = [&](int i) {
    return std::max(1.0, condition(reference.crba(q.col(i))) / 1e4);
  };
  compare(
      "Minv", [&](int i) { return flat(reference.minv(q.col(i))); }, solving);
  compare(
      "qdd", [&](int i) { return reference.aba(q.col(i), v.col(i), tau.col(i)); }, solving);
}

/// Pinocchio's own coordinates of continuous joints.
TEST_P(ReferenceOracle, AgreesOnCosinesAndSines) {
  ModelOptions options;
  options.continuous = ContinuousAs::kCosSin;
  options.order = JointOrder::kAlphabetical;
  options.snap = 0;
  Diagnostics diagnostics;
  const Reference reference(configure(model_, options, diagnostics));
  const auto rows = [&](const char* quantity) -> MatrixXd {
    return oracle(GetParam(), quantity).transpose();
  };
  const MatrixXd q = rows("q"), v = rows("v"), a = rows("a");
  ASSERT_EQ(reference.nq(), q.rows());
  const auto rounding = [](int) { return 1.0; };
  compare(
      "tau", [&](int i) { return reference.rnea(q.col(i), v.col(i), a.col(i)); }, rounding);
  compare(
      "M", [&](int i) { return flat(reference.crba(q.col(i))); }, rounding);
}

TEST_P(ReferenceOracle, PutsJointsInTheSamePlaces) {
  std::vector<std::string> joints;
  std::vector<int> links;
  for (const Joint& joint : model_.joints) {
    if (joint.type == JointType::kFixed) continue;
    joints.push_back(joint.name);
    links.push_back(joint.child);
  }
  EXPECT_EQ(joints, oracle_joints(GetParam()));

  const Reference reference(model_);
  const MatrixXd q = oracle(GetParam(), "qflat");
  const auto poses = [&](int i) {
    const std::vector<Placement> T = reference.fk(q.row(i).transpose());
    VectorXd result(12 * links.size());
    for (size_t k = 0; k < links.size(); ++k)
      result.segment<12>(12 * k) << flat(T[links[k]].R), T[links[k]].p;
    return result;
  };
  compare("oMi", poses, [](int) { return 1.0; });
}

INSTANTIATE_TEST_SUITE_P(Robots, ReferenceOracle, testing::ValuesIn(oracle_robots()),
                         [](const auto& robot) { return std::string(robot.param.name); });

}  // namespace
}  // namespace arboc::test

// Joint Jacobian, centroidal map and regressor against Pinocchio's recorded results for fifteen
// public robots.
#include <gtest/gtest.h>

#include <filesystem>

#include "frontend/urdf.h"
#include "support/kinematics.h"
#include "support/oracle.h"
#include "tree/lower.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;

constexpr double kRounding = 1e-12;  // of sums over a tree, relative to a row's largest entry

std::vector<double> row(const MatrixXd& table, int i) {
  const Eigen::VectorXd values = table.row(i);
  return {values.begin(), values.end()};
}

void expect_near(const double* got, const std::vector<double>& expected, const std::string& what) {
  double error = 0, largest = 0;
  for (size_t k = 0; k < expected.size(); ++k) {
    if (!(std::fabs(got[k] - expected[k]) <= error)) error = std::fabs(got[k] - expected[k]);
    largest = std::max(largest, std::fabs(expected[k]));
  }
  EXPECT_LE(error, kRounding * largest) << what;
}

class KinematicsOracle : public testing::TestWithParam<OracleRobot> {};

TEST_P(KinematicsOracle, Agrees) {
  const OracleRobot robot = GetParam();
  const MatrixXd J = oracle(robot, "J"), A = oracle(robot, "Ag"), Y = oracle(robot, "regressor");
  if (!std::filesystem::exists(oracle_urdf(robot)) || J.size() == 0)
    GTEST_SKIP() << "no recorded results for " << robot.name;
  ModelOptions options;
  options.base = robot.base;
  options.mimic = MimicPolicy::kIndependent;
  options.order = JointOrder::kAlphabetical;
  options.snap = 0;
  Diagnostics diagnostics;
  const Model model = configure(read_urdf(oracle_urdf(robot), diagnostics), options, diagnostics);
  const DynamicTree tree = lower(model, {FrameChoice::kAxis, false});
  const MatrixXd q = oracle(robot, "qflat"), v = oracle(robot, "v"), a = oracle(robot, "a");
  ASSERT_EQ(6 * tree.nv, J.cols());
  ASSERT_EQ(6 * tree.nv, A.cols());
  ASSERT_EQ(10 * tree.nv * tree.nb(), Y.cols());
  for (int i = 0; i < q.rows(); ++i) {
    const KinematicInputs<double> in{row(q, i), row(v, i), row(a, i), {}};
    const std::string state = ", state " + std::to_string(i);
    expect_near(run_other("joint_jacobians", tree, in).data(), row(J, i), "J" + state);
    expect_near(run_other("centroidal", tree, in).data() + 6, row(A, i), "A" + state);
    expect_near(run_other("regressor", tree, in).data(), row(Y, i), "Y" + state);
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, KinematicsOracle, testing::ValuesIn(oracle_robots()),
                         [](const auto& robot) { return std::string(robot.param.name); });

}  // namespace
}  // namespace arboc::test

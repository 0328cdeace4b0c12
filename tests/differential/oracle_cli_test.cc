// `arboc eval` against Pinocchio's recorded results for fifteen public robots: what a user who
// compares the two would type.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/engines.h"
#include "support/oracle.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

struct Quantity {
  const char* function;
  const char* expected;
  std::vector<const char*> inputs;  ///< option and file in turn
  const char* output = "";          ///< of several
};

const std::vector<Quantity> kQuantities = {
    {"fk", "oMi", {"--q", "qflat"}},
    {"rnea", "tau", {"--q", "qflat", "--v", "v", "--a", "a"}},
    {"gravity", "grav", {"--q", "qflat"}},
    {"nle", "nle", {"--q", "qflat", "--v", "v"}},
    {"crba", "M", {"--q", "qflat"}},
    {"minv", "Minv", {"--q", "qflat"}},
    {"aba", "qdd", {"--q", "qflat", "--v", "v", "--tau", "tau_in"}},
    {"joint_jacobians", "J", {"--q", "qflat"}},
    {"centroidal", "Ag", {"--q", "qflat"}, "A_G"},
    {"regressor", "regressor", {"--q", "qflat", "--v", "v", "--a", "a"}},
    {"rnea_derivatives", "dtau_dq", {"--q", "qflat", "--v", "v", "--a", "a"}, "dtau_dq"},
    {"rnea_derivatives", "dtau_dv", {"--q", "qflat", "--v", "v", "--a", "a"}, "dtau_dv"},
    {"aba_derivatives", "dqdd_dq", {"--q", "qflat", "--v", "v", "--tau", "tau_in"}, "dqdd_dq"},
    {"aba_derivatives", "dqdd_dv", {"--q", "qflat", "--v", "v", "--tau", "tau_in"}, "dqdd_dv"},
    {"aba_derivatives", "Minv", {"--q", "qflat", "--v", "v", "--tau", "tau_in"}, "Minv"}};

std::vector<double> row(const Eigen::MatrixXd& A, Eigen::Index i) {
  const Eigen::VectorXd x = A.row(i);
  return {x.begin(), x.end()};
}

bool recorded(const OracleRobot& robot) {
  return std::filesystem::exists(oracle_urdf(robot)) && oracle(robot, "q").size() > 0;
}

/// All functions on all states; `snap` empty: the default.
void expect_agreement(const OracleRobot& robot, const std::string& snap, const std::string& engine,
                      double rounding) {
  const std::string urdf = oracle_urdf(robot);
  const std::string folder = std::filesystem::path(urdf).parent_path().parent_path() / "oracle";
  const Eigen::MatrixXd inertias = oracle(robot, "M");
  for (const Quantity& quantity : kQuantities) {
    std::vector<std::string> command{
        "eval",          urdf,
        "--function",    quantity.function,
        "--engine",      engine,
        "--mimic",       "independent",
        "--joint-order", "alphabetical",
        "--base",        robot.base == Base::kFixed ? "fixed" : "floating"};
    for (const std::string word : quantity.inputs)
      command.push_back(word.starts_with("--") ? word
                                               : folder + "/" + robot.name + "/" + word + ".csv");
    if (*quantity.output) command.insert(command.end(), {"--output", quantity.output});
    if (!snap.empty()) command.insert(command.end(), {"--snap", snap});
    const Outcome outcome = run_arboc(command);
    ASSERT_EQ(outcome.status, 0) << quantity.function << "\n" << outcome.err;
    const auto results = numbers(outcome.out);
    const Eigen::MatrixXd expected = oracle(robot, quantity.expected);
    ASSERT_EQ(results.size(), static_cast<size_t>(expected.rows()));
    for (Eigen::Index i = 0; i < expected.rows(); ++i) {
      const std::vector<double> M = row(inertias, i);
      const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(M.size())));
      const std::string function = quantity.function;
      const bool solves = function.starts_with("aba") || function == "minv";
      const double allowed =
          solves ? rounding * std::max(1.0, condition(matrix_of(M, n)) / 1e4) : rounding;
      EXPECT_LE(relative_error(results[static_cast<size_t>(i)], row(expected, i)), allowed)
          << function << ", state " << i;
    }
  }
}

class OracleCli : public testing::TestWithParam<OracleRobot> {
 protected:
  void SetUp() override {
    if (!recorded(GetParam())) GTEST_SKIP() << "no recorded results for " << GetParam().name;
  }
};

TEST_P(OracleCli, GenericAgreesOnTheAnglesAsWritten) {
  expect_agreement(GetParam(), "0", "generic", 1e-12);
}

TEST_P(OracleCli, GenericAgreesOnSnappedAngles) {
  // Right angles written with ten digits move that much.
  expect_agreement(GetParam(), "", "generic", 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Robots, OracleCli, testing::ValuesIn(oracle_robots()),
                         [](const auto& robot) { return std::string(robot.param.name); });

TEST(OracleCliGenerated, Agrees) {
  const OracleRobot robot{"solo12", Base::kFloating};
  if (!recorded(robot)) GTEST_SKIP() << "no recorded results for " << robot.name;
  expect_agreement(robot, "0", "generated", 1e-12);
}

}  // namespace
}  // namespace arboc::test

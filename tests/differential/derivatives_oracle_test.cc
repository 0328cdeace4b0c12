// rnea_derivatives, traced and generic, against Pinocchio's recorded results for fifteen robots.
#include <gtest/gtest.h>

#include <filesystem>

#include "compile.h"
#include "frontend/urdf.h"
#include "support/oracle.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;

constexpr double kRounding = 1e-12;  // of sums over a tree, relative to a row's largest entry

std::vector<double> row(const MatrixXd& table, int i) {
  const Eigen::VectorXd values = table.row(i);
  return {values.begin(), values.end()};
}

/// The traced function's outputs, dense and row by row.
Values evaluate_traced(const CompiledFunction& f, const Values& in) {
  const auto raw = evaluate(f.graph, {in.at("q"), in.at("v"), in.at("a")});
  Values out;
  for (size_t k = 0; k < f.signature.outputs.size(); ++k) {
    const Argument& a = f.signature.outputs[k];
    std::vector<double> dense(static_cast<size_t>(a.rows * a.cols));
    const Pattern& pattern = f.patterns[k];
    for (size_t e = 0; e < pattern.row.size(); ++e) {
      dense[static_cast<size_t>(pattern.row[e] * a.cols + pattern.col[e])] = raw[k][e];
      if (a.symmetric)
        dense[static_cast<size_t>(pattern.col[e] * a.cols + pattern.row[e])] = raw[k][e];
    }
    out[a.name] = dense;
  }
  return out;
}

void expect_near(const std::vector<double>& got, const std::vector<double>& expected,
                 const std::string& what) {
  ASSERT_EQ(got.size(), expected.size()) << what;
  double error = 0, largest = 0;
  for (size_t k = 0; k < got.size(); ++k) {
    if (!(std::fabs(got[k] - expected[k]) <= error)) error = std::fabs(got[k] - expected[k]);
    largest = std::max(largest, std::fabs(expected[k]));
  }
  EXPECT_LE(error, kRounding * largest) << what;
}

class DerivativesOracle : public testing::TestWithParam<OracleRobot> {};

TEST_P(DerivativesOracle, Agree) {
  const OracleRobot robot = GetParam();
  const MatrixXd dq = oracle(robot, "dtau_dq");
  if (!std::filesystem::exists(oracle_urdf(robot)) || dq.size() == 0)
    GTEST_SKIP() << "no recorded results for " << robot.name;
  ModelOptions options;
  options.base = robot.base;
  options.mimic = MimicPolicy::kIndependent;
  options.order = JointOrder::kAlphabetical;
  options.snap = 0;
  Diagnostics diagnostics;
  const Model model = configure(read_urdf(oracle_urdf(robot), diagnostics), options, diagnostics);
  const CompiledFunction f = compile_function({"rnea_derivatives"}, resolve(model));
  const MatrixXd q = oracle(robot, "qflat"), v = oracle(robot, "v"), a = oracle(robot, "a");
  const MatrixXd dv = oracle(robot, "dtau_dv"), M = oracle(robot, "M");
  for (int i = 0; i < q.rows(); ++i) {
    const Values in{{"q", row(q, i)}, {"v", row(v, i)}, {"a", row(a, i)}};
    const Values engines[] = {evaluate_traced(f, in),
                              evaluate_generic(f.request, resolve(model), f.lowering, in)};
    for (const Values& got : engines) {
      const std::string state = ", state " + std::to_string(i);
      expect_near(got.at("dtau_dq"), row(dq, i), "dtau_dq" + state);
      expect_near(got.at("dtau_dv"), row(dv, i), "dtau_dv" + state);
      expect_near(got.at("M"), row(M, i), "M" + state);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, DerivativesOracle, testing::ValuesIn(oracle_robots()),
                         [](const auto& robot) { return std::string(robot.param.name); });

}  // namespace
}  // namespace arboc::test

// rnea_hessian as derivatives of derivatives against Pinocchio's recorded second-order tensors, for
// the public robots that have them (at most 20 degrees of freedom).
//
// lambda = unit vector i gives the layer i of a tensor; entry i + nv j + nv^2 k of a record.
#include <gtest/gtest.h>

#include <filesystem>

#include "passes/passes.h"
#include "support/engines.h"
#include "support/oracle.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;

constexpr double kRecorded = 1e-10;  // what the recorded tensors state for themselves

struct Tensor {
  const char* output;
  const char* recorded;
  bool swapped;  ///< the record has the second input first
};
constexpr Tensor kTensors[] = {{"H_qq", "d2tau_dqdq", false},
                               {"H_qv", "d2tau_dqdv", false},
                               {"H_vv", "d2tau_dvdv", false},
                               {"H_qa", "d2tau_dadq", true}};

class HessianOracle : public testing::TestWithParam<OracleRobot> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(oracle_urdf(GetParam())) ||
        oracle(GetParam(), "d2tau_dqdq").size() == 0)
      GTEST_SKIP() << "no recorded second derivatives of " << GetParam().name;
  }
};

std::vector<double> row(const MatrixXd& A, Eigen::Index i) {
  const Eigen::VectorXd x = A.row(i);
  return {x.begin(), x.end()};
}

TEST_P(HessianOracle, Agrees) {
  const OracleRobot robot = GetParam();
  ModelOptions options;
  options.base = robot.base;
  options.mimic = MimicPolicy::kIndependent;
  options.order = JointOrder::kAlphabetical;
  options.snap = 0;
  FunctionOptions how;
  how.iterated = true;
  const arboc::Setup setup = resolve(model_from(oracle_urdf(robot), options), how);
  const CompiledFunction f = compile_function({"rnea_hessian"}, setup);
  const MatrixXd q = oracle(robot, "qflat"), v = oracle(robot, "v"), a = oracle(robot, "a");
  const int n = setup.nv;
  for (const Tensor& tensor : kTensors) {
    const MatrixXd recorded = oracle(robot, tensor.recorded);
    size_t output = 0;
    while (f.signature.outputs[output].name != tensor.output) ++output;
    const Pattern& pattern = f.patterns[output];
    for (Eigen::Index s = 0; s < recorded.rows(); ++s) {
      double error = 0;
      for (int i = 0; i < n; ++i) {
        std::vector<double> lambda(static_cast<size_t>(n), 0.0);
        lambda[static_cast<size_t>(i)] = 1;
        const auto results = evaluate(f.graph, {row(q, s), row(v, s), row(a, s), lambda});
        MatrixXd H = MatrixXd::Zero(n, n);
        for (size_t e = 0; e < pattern.row.size(); ++e)
          H(pattern.row[e], pattern.col[e]) = results[output][e];
        for (int j = 0; j < n; ++j)
          for (int k = 0; k < n; ++k) {
            const double expected =
                recorded(s, i + n * (tensor.swapped ? k : j) + n * n * (tensor.swapped ? j : k));
            error = std::max(error, std::fabs(H(j, k) - expected));
          }
      }
      EXPECT_LE(error, kRecorded * recorded.row(s).cwiseAbs().maxCoeff())
          << tensor.output << ", state " << s;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, HessianOracle, testing::ValuesIn(oracle_robots()),
                         [](const auto& robot) { return std::string(robot.param.name); });

}  // namespace
}  // namespace arboc::test

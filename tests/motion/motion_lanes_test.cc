// Functions of motions at many instants at a time, in lanes and on threads, against one by one.
#include <gtest/gtest.h>
#include <posture/models.h>

#include <Eigen/Core>

#include <random>

namespace arboc::test {
namespace {

using Eigen::VectorXd;
using nlp::Function;

/// Derivatives of torques are up to some 1e4; lanes and the scalar text round otherwise.
double difference(const VectorXd& a, const VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / std::max(1.0, b.cwiseAbs().maxCoeff());
}

void expect_as_one_by_one(Function& f, int n) {
  const auto inputs = f.inputs(), outputs = f.outputs();
  const auto J = static_cast<Eigen::Index>(f.jacobian_pattern().size());
  const auto H = static_cast<Eigen::Index>(f.hessian_pattern().size());
  std::mt19937_64 random(static_cast<unsigned>(n));
  const auto numbers = [&](Eigen::Index count) {
    VectorXd x(count);
    for (double& e : x) e = std::uniform_real_distribution<double>(-1, 1)(random);
    return x;
  };
  const VectorXd x = numbers(n * inputs), w = numbers(n * outputs);
  VectorXd all[3] = {VectorXd(n * outputs), VectorXd(n * J), VectorXd(n * H)}, one[3];
  for (int k = 0; k < 3; ++k) one[k] = VectorXd(all[k].size());
  f.values(n, x.data(), all[0].data());
  f.jacobian(n, x.data(), all[1].data());
  f.hessian(n, x.data(), w.data(), all[2].data());
  for (Eigen::Index s = 0; s < n; ++s) {
    f.values(1, x.data() + s * inputs, one[0].data() + s * outputs);
    f.jacobian(1, x.data() + s * inputs, one[1].data() + s * J);
    f.hessian(1, x.data() + s * inputs, w.data() + s * outputs, one[2].data() + s * H);
  }
  for (int k = 0; k < 3; ++k) EXPECT_LT(difference(all[k], one[k]), 1e-13) << n << " " << k;
}

TEST(MotionLanes, GiveWhatSinglePointsGive) {
  for (const char* name : {"nine_dof", "humanoid", "santos"}) {
    SCOPED_TRACE(name);
    const nlp::Robot& robot = posture::model(name).robot;
    for (const auto& f : {robot.dynamics, robot.placements}) {
      for (const int threads : {1, 2}) {
        f->use_threads(threads);
        for (const int n : {2, 3, 4, 9, 21}) expect_as_one_by_one(*f, n);
      }
    }
  }
}

}  // namespace
}  // namespace arboc::test

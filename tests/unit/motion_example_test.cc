// The code of docs/motion.md: it stands here word for word, is compiled, and does what is said.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "arboc/measures/energy.hpp"
#include "arboc/measures/torque.hpp"
#include "arboc/motion/basis_matrix.hpp"
#include "arboc/motion/point_to_point.hpp"

namespace arboc::test {
namespace {

// clang-format off
TEST(MotionPage, Splines) {
  const Eigen::Vector2d start(0.1, -1), end(0.5, 0.4);
  const auto basis = arboc::BSplineBasis::clamped_uniform(3, 23, 0, 2);  // degree, points, s
  Eigen::MatrixXd P = (end - start) * (basis.greville() / 2).transpose();  // a straight line
  P.colwise() += start;
  P.leftCols(3).colwise() = start;   // three equal control points: at rest
  P.rightCols(3).colwise() = end;
  const arboc::BSpline q(basis, P);
  const Eigen::VectorXd v = q(0.7, 1), a = q(0.7, 2);  // rad/s, rad/s^2
  const arboc::CurveBounds speed = q.derivative().bounds();   // never exceeded
  EXPECT_NEAR(v[0], 0.2, 1e-14);
  EXPECT_NEAR(a[1], 0, 1e-13);
  EXPECT_LE(v[1], speed.upper[1] + 1e-15);

  const Eigen::VectorXd frames = basis.greville().segment(3, 17);
  const arboc::SparseRows B0 = arboc::basis_rows(basis, frames, 0).sparse();  // 17 x 23
  const arboc::SparseRows B2 = arboc::basis_rows(basis, frames, 2).sparse();  // same pattern
  const Eigen::MatrixXd accelerations = P * B2.transpose();                   // coordinates x 17
  const arboc::BSpline through = arboc::fit(basis, basis.greville(), P);      // values at instants
  EXPECT_EQ(B0.nonZeros(), 17 * 4);
  EXPECT_NEAR(accelerations(0, 8), q(frames[8], 2)[0], 1e-12);
  EXPECT_NEAR(through(basis.greville()[9])[1], P(1, 9), 1e-13);
}

TEST(MotionPage, FromRestToRest) {
  const Eigen::Vector3d from(0, 0, 1), to(0.6, 0.8, 1), limits(0.5, 0.6, 1);
  const auto elbow = arboc::MotionFunction::limited({0.2, 1.2, 0, 1}, 1.5);  // from, to, begin, duration
  const arboc::MotionSample x = elbow(0.5);  // position, velocity, acceleration, jerk
  const auto hand = arboc::MotionPath::along_line({from, to, 0, 2}, 0.8);    // limit of the speed, m/s
  const auto arm = arboc::MotionPath::by_coordinate({from, to, 0, 2}, limits);  // one limit each
  EXPECT_NEAR(x.position, 0.7, 1e-15);
  EXPECT_NEAR(x.velocity, 1.5, 1e-15);
  EXPECT_NEAR(hand(1).velocity.norm(), 0.8, 1e-15);
  EXPECT_NEAR(arm(1).velocity[1], 0.6, 1e-15);
}

TEST(MotionPage, Measures) {
  const Eigen::Vector2d tau(3, -2), rate(-1, -1), lower(-4, -4), upper(6, 6);
  const auto cost = arboc::sum_over_joints(tau, rate, [](double t, double w) {
    return arboc::smooth_joint_effort(t, w);  // value, d_tau, d_w, d_tau_tau, d_tau_w, d_w_w
  });
  EXPECT_NEAR(cost.value, arboc::effort(tau, rate), 1e-3);

  const arboc::TorqueLimits strength(lower, upper);                       // N m
  const double hardest = arboc::normalised_torque(tau, strength).maxCoeff();
  const arboc::TorqueMeasure norm = arboc::normalised_torque_norm(tau, strength, 100);
  const Eigen::MatrixXd H = norm.hessian();  // diag(norm.diagonal) - norm.rank_one norm.rank_one^T
  EXPECT_EQ(hardest, 0.5);
  EXPECT_GE(norm.value, 1.25);
  EXPECT_EQ(H(0, 1), H(1, 0));
}
// clang-format on

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(ARBOC_SOURCE_DIR "/" + path).rdbuf();
  return text.str();
}

TEST(MotionPage, ShowsTheCodeAbove) {
  const std::string here = text_of("tests/unit/motion_example_test.cc");
  std::istringstream page(text_of("docs/motion.md"));
  int blocks = 0;
  std::string block;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line == "```cpp") {
      inside = true;
      block.clear();
    } else if (inside && line == "```") {
      inside = false;
      ++blocks;
      EXPECT_NE(here.find(block), std::string::npos) << block;
    } else if (inside) {
      block += line.empty() ? "\n" : "  " + line + "\n";
    }
  }
  EXPECT_EQ(blocks, 5);
}

}  // namespace
}  // namespace arboc::test

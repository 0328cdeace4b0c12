// Both hands on bars: a closed chain, its multipliers, forces on hands.
#include <gtest/gtest.h>

#include <cmath>

#include "ladder/report.h"

namespace arboc::test {
namespace {

namespace la = ladder;
using la::Joints;

const std::string kTasks = ARBOC_SOURCE_DIR "/apps/ladder/tasks/";

la::Task task(const std::string& name) { return la::read_task(kTasks + name + ".toml"); }

/// Bars push as hard as the body's momentum changes.
TEST(Ladder, ForcesOnHandsMoveTheBody) {
  const la::Result r = la::traverse(task("traverse"));
  for (Eigen::Index k = 0; k < r.hand_forces.rows(); ++k) {
    const bool right = r.hand_forces.row(k).head<3>().norm() > 0,
               left = r.hand_forces.row(k).tail<3>().norm() > 0;
    EXPECT_FALSE(right && left) << k;
    Joints q = r.q.row(k).transpose(), v = r.effort.rates.row(k).transpose(),
           a = r.effort.accelerations.row(k).transpose();
    double dh[6];
    const la::Tree& held = la::tree(right ? la::kRight : la::kLeft);
    held.momentum_rate(held.own(q), held.own(v), held.own(a), dh);
    const Eigen::Vector3d force = r.hand_forces.row(k).segment<3>(right ? 0 : 3).transpose();
    EXPECT_LT((force - Eigen::Vector3d(dh)).norm(), 1e-10) << k;
  }
  const la::Result both = la::both_hands(task("both_hands"));
  for (Eigen::Index k = 10; k + 10 < both.q.rows(); k += 17) {
    Joints q = both.q.row(k).transpose(), v = both.effort.rates.row(k).transpose(),
           a = both.effort.accelerations.row(k).transpose();
    double dh[6];
    la::tree(la::kRight).momentum_rate(q, v, a, dh);
    const Eigen::Vector3d sum =
        (both.hand_forces.row(k).head<3>() + both.hand_forces.row(k).tail<3>()).transpose();
    EXPECT_LT((sum - Eigen::Vector3d(dh)).norm(), 1e-10);
  }
}

TEST(Ladder, BothHandsCloseAChain) {
  const la::Task t = task("both_hands");
  const la::Result r = la::both_hands(t);
  EXPECT_LT(r.loop_error, 1e-12);
  EXPECT_LT(r.loop_speed, 1e-12);
  const la::TorsoState torso{{-0.42, 0.1, 0.1}, 0.2, 0.3, -0.4, 1, -2, 1.5};
  const la::Vector3 hand(0, la::lengths().shoulders, 0.3);
  const la::Closed c = la::closed(torso, hand, {1, 1}, {0, -0.4, 0.7});
  EXPECT_LT(c.tau.squaredNorm(), c.tau_open.squaredNorm());
  // Other multipliers cost more torque.
  for (int k = 0; k < 6; ++k) {
    Eigen::Matrix<double, 6 * la::kFrames, la::kJoints> J;
    la::tree(la::kRight).jacobian(c.state.q, J.data());
    const Joints other = c.tau - 0.1 * J.row(6 * la::kLeftHand + k).transpose();
    EXPECT_GE(other.squaredNorm(), c.tau.squaredNorm() - 1e-12) << k;
  }
  // Forward dynamics with these torques gives these accelerations, and the multipliers back.
  const la::ClosedForward f = la::closed_forward(c.state.q, c.state.v, c.tau);
  EXPECT_LT((f.a - c.state.a).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((f.lambda - c.lambda).cwiseAbs().maxCoeff(), 1e-8);
}

/// Of the torso as asked, and of hands that stay: by differences.
TEST(Ladder, RatesOfTheClosedChain) {
  const la::Vector3 hand(0, la::lengths().shoulders, 0), legs(0, 0, 0);
  const auto at = [&](double t) {
    return la::inverse({-0.45 + 0.2 * t + 0.5 * t * t, -0.3 * t + t * t, 0.4 * t}, hand, {1, 1},
                       legs);
  };
  const la::State s = la::moving(at(0), {{-0.45, 0, 0}, 0.2, -0.3, 0.4, 1, 2, 0});
  const double h = 1e-4;
  const Joints v = (at(h) - at(-h)) / (2 * h), a = (at(h) - 2 * at(0) + at(-h)) / (h * h);
  EXPECT_LT((v - s.v).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((a - s.a).cwiseAbs().maxCoeff(), 1e-5);
}

}  // namespace
}  // namespace arboc::test

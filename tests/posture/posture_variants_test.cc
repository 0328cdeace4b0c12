// What tasks may ask for besides: one example and one number each.
#include <cmath>

#include "posture/posture_support.h"

namespace arboc::test {
namespace {

constexpr double kDegree = M_PI / 180;

/// R by rows, p of a frame at a result.
struct Frame {
  Eigen::Matrix3d R;
  Eigen::Vector3d p;
};
Frame frame_of(const std::string& model, const posture::Result& r, const std::string& name) {
  const nlp::Robot& robot = posture::model(model).robot;
  std::vector<double> all(static_cast<std::size_t>(robot.placements->outputs()));
  robot.placements->values(1, r.q.data(), all.data());
  const double* at = all.data() + 12 * robot.frame(name);
  return {Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(at),
          Eigen::Vector3d(at + 9)};
}

TEST(PostureVariants, AHeadThatLooksAhead) {
  const posture::Result hanging = solve_task("santos_trial2_obj3", 1),
                        r = solve_task("santos_look", 1);
  expect_solved(r, "look");
  const auto pitch = [](const posture::Result& of) {
    const Eigen::Vector3d gaze = frame_of("santos", of, "z37").R.col(1);
    return std::acos(gaze.z()) / kDegree;
  };
  EXPECT_GT(pitch(hanging), 20);
  EXPECT_LE(pitch(r), 20 + 1e-6);
}

TEST(PostureVariants, FrictionConesHold) {
  const posture::Result r = solve_task("santos_friction", 1);
  expect_solved(r, "friction");
  for (std::size_t c = 2; c < 4; ++c) {
    const auto& f = r.reactions[c];
    EXPECT_LE(std::hypot(f[0], f[2]), 0.1 * f[1] + 1e-8);
  }
}

TEST(PostureVariants, ABackpackWeighs) {
  const posture::Task t = task("santos_backpack");
  const posture::Result r = solve_task("santos_backpack", 1);
  expect_solved(r, "backpack");
  double up = 0;
  for (const auto& w : r.reactions) up += w[1];
  EXPECT_NEAR(up, (98.3 + 15) * 9.81, 1e-6);
  expect_equilibrium("santos/santos.dh.toml", {}, t, r);
}

TEST(PostureVariants, HeelsAndBallsOnlyPush) {
  const posture::Task t = task("santos_heels");
  const posture::Result r = solve_task("santos_heels", 3);
  expect_solved(r, "heels");
  for (std::size_t c = 2; c < 6; ++c) EXPECT_GE(r.reactions[c][1], -1e-8);
  EXPECT_NEAR(frame_of("santos", r, "r_heel").p.y(), -0.85674991, 1e-7);
  expect_equilibrium("santos/santos.dh.toml", {}, t, r);
}

TEST(PostureVariants, ForcesAlongTheHandsOwnAxesAndAPointOnALine) {
  const posture::Task t = task("santos_line");
  const posture::Result r = solve_task("santos_line", 2);
  expect_solved(r, "line");
  const Frame hip = frame_of("santos", r, "hip");
  EXPECT_NEAR(hip.p.x(), 0, 1e-8);
  EXPECT_NEAR(hip.p.z(), 0.1, 1e-8);
  for (std::size_t c = 0; c < 2; ++c) {
    const Eigen::Vector3d own = frame_of("santos", r, t.contacts[c].frame).R.transpose() *
                                Eigen::Vector3d(r.reactions[c].data());
    EXPECT_LE(own.y(), 200 + 1e-6);
    EXPECT_GE(own.y(), -400 - 1e-6);
  }
  expect_equilibrium("santos/santos.dh.toml", {}, t, r);
}

TEST(PostureVariants, SpheresDoNotMeet) {
  const posture::Task t = task("santos_spheres");
  const posture::Result r = solve_task("santos_spheres", 2);
  expect_solved(r, "spheres");
  const auto all = posture::pairs(t);
  for (const double gap : posture::gaps(t, posture::model("santos"), all, r.q))
    EXPECT_GE(gap, -1e-8);
  // They do where nobody looks.
  const posture::Result blind = solve_task("santos_trial2_obj3", 1);
  const auto gaps = posture::gaps(t, posture::model("santos"), all, blind.q);
  EXPECT_LT(*std::min_element(gaps.begin(), gaps.end()), 0);
}

TEST(PostureVariants, SymmetricPostures) {
  const posture::Result r = solve_task("santos_symmetric", 2);
  expect_solved(r, "symmetric");
  const Frame right = frame_of("santos", r, "z17"), left = frame_of("santos", r, "z27");
  // Coordinates mirror each other to 1e-3, as the arms' lengths differ by 9 um.
  EXPECT_NEAR(right.p.x(), -left.p.x(), 2e-3);
  EXPECT_NEAR(right.p.y(), left.p.y(), 2e-3);
  EXPECT_NEAR(right.p.z(), left.p.z(), 2e-3);
  const nlp::Robot& robot = posture::model("santos").robot;
  for (const posture::Mirror& m : task("santos_symmetric").mirrors)
    EXPECT_NEAR(r.q[static_cast<std::size_t>(robot.coordinate(m.left))],
                m.sign * r.q[static_cast<std::size_t>(robot.coordinate(m.right))], 1e-3 + 1e-8);
}

TEST(PostureVariants, ARobotFromUrdfStandsWithLoads) {
  const posture::Task t = task("humanoid_standing");
  const posture::Result r = solve_task("humanoid_standing", 2);
  expect_solved(r, "humanoid");
  ModelOptions options;
  options.base = Base::kFloating;
  options.expand = true;
  const Eigen::VectorXd tau = reference_torques("humanoid/humanoid.urdf", options, t, r);
  for (Eigen::Index i = 0; i < 6; ++i) EXPECT_NEAR(tau[i], 0, 1e-6);
  double up = 0;
  for (const auto& w : r.reactions) up += w[2];
  EXPECT_NEAR(up, 75 * 9.81 + 98.1 + 2 * 49.05, 1e-5);
}

TEST(PostureVariants, SaysWhichLimitsConflict) {
  posture::Task t = task("santos_trial2_obj3");
  for (auto& contact : t.contacts) contact.force[1] = {-100, 200};  // cannot carry the weight
  t.search.starts = 1;
  t.search.restarts = 0;
  const posture::Result r = solve_task(t);
  EXPECT_EQ(r.status, nlp::Status::kInfeasible) << r.reason;
  EXPECT_NE(r.reason.find("equilibrium"), std::string::npos) << r.reason;
}

}  // namespace
}  // namespace arboc::test

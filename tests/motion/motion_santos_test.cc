// The human of [Thesis] chapter 6, with full dynamics.
#include "motion/motion_support.h"

namespace arboc::test {
namespace {

using Eigen::VectorXd;

/// Forces of passive coordinates and torques by the reference engine, which reads the model's file.
void expect_reference_agrees(const motion::Task& t, const motion::Result& r, Eigen::Index k) {
  Diagnostics diagnostics;
  const Model model = configure(
      read_model(ARBOC_SOURCE_DIR "/models/santos/santos.dh.toml", diagnostics), {}, diagnostics);
  JointForces springs;
  springs.stiffness = true;
  const Reference reference(model, springs);
  Loads loads;
  for (std::size_t c = 0; c < t.start.posture.contacts.size(); ++c) {
    int link = -1;
    for (std::size_t i = 0; i < model.links.size(); ++i)
      if (model.links[i].name == t.start.posture.contacts[c].frame) link = static_cast<int>(i);
    ASSERT_GE(link, 0);
    LinkWrench load{link, Axes::kAligned, {}};  // these contacts are at the frames' origins
    load.wrench =
        r.samples.reactions.row(k).segment<6>(static_cast<Eigen::Index>(6 * c)).transpose();
    loads.push_back(load);
  }
  const VectorXd q = r.samples.q.row(k), v = r.samples.v.row(k), a = r.samples.a.row(k);
  const VectorXd tau = reference.rnea(q, v, a, loads);
  EXPECT_LT((tau - r.samples.tau.row(k).transpose()).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(SantosMotion, LeansWithFullDynamics) {
  const motion::Task t = motion_task("santos_lean");
  const motion::Result r = solve_motion(t);
  expect_moves(t, r);
  EXPECT_EQ(r.stages.front().control_points, 23);
  EXPECT_EQ(r.stages.front().contact_frames, 17);
  for (const Eigen::Index k : {Eigen::Index(0), r.samples.t.size() / 3, r.samples.t.size() / 2})
    expect_reference_agrees(t, r, k);
  expect_same_reactions(t, r);
}

TEST(SantosMotion, PullsHisHeadOverTheBar) {
  const motion::Task t = motion_task("santos_pull_up");
  const motion::Result r = solve_motion(t);
  expect_moves(t, r);
  const auto at = static_cast<Eigen::Index>((r.samples.t.size() - 1) / 2);
  const int head = 12 * posture::model("santos").robot.frame("head");
  EXPECT_GE(r.samples.placements(at, head + 10), 0.40 - 1e-6);  // the bar is at 0.25
  // The feet push with less than half of the weight at any time.
  EXPECT_LE((r.samples.reactions.col(13) + r.samples.reactions.col(19)).maxCoeff(), 460 + 1e-6);
}

TEST(HumanoidMotion, StepsWithoutTouchingTheGround) {
  const motion::Task t = motion_task("humanoid_step");
  const motion::Result r = solve_motion(t);
  expect_moves(t, r);
  const int foot = 12 * posture::model("humanoid").robot.frame("right_foot");
  for (Eigen::Index k = 0; k < r.samples.t.size(); ++k)
    EXPECT_GE(r.samples.placements(k, foot + 11), 0.06825 - 2e-3) << r.samples.t[k];
}

}  // namespace
}  // namespace arboc::test

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

/// Heel and toes stay above the ground, which for them is 1 mm lower: at frames to what the solver
/// leaves of rows, 1e-8 m, and between frames to what the audit finds.
TEST(HumanoidMotion, StepsWithoutTouchingTheGround) {
  const motion::Task t = motion_task("humanoid_step");
  const motion::Model& model = posture::model(t.model);
  const motion::Result r = solve_motion(t);
  expect_moves(t, r);
  const auto lowest = [&](const VectorXd& placements) {
    double least = 1;
    for (std::size_t c = 1; c < 3; ++c) {
      const nlp::Contact& contact = t.start.posture.contacts[c];
      EXPECT_EQ(contact.place.kind, nlp::Place::Kind::kAbove);
      const nlp::Placement at(placements.data() + 12 * model.robot.frame(contact.frame));
      least = std::min(least, at(contact.point).z());
    }
    return least;
  };
  const VectorXd frames = r.motion->q.basis().greville();
  for (Eigen::Index k = 3; k < frames.size() - 3; ++k) {
    const VectorXd q = r.motion->q(frames[k]);
    VectorXd placements(model.robot.placements->outputs());
    model.robot.placements->values(1, q.data(), placements.data());
    EXPECT_GE(lowest(placements), -1e-3 - 1e-7) << frames[k];
  }
  for (Eigen::Index k = 0; k < r.samples.t.size(); ++k)
    EXPECT_GE(lowest(r.samples.placements.row(k).transpose()), -1e-3 - r.audit.drift.value - 1e-9)
        << r.samples.t[k];
  const auto middle = (r.samples.t.size() - 1) / 2;
  EXPECT_GE(lowest(r.samples.placements.row(middle).transpose()), 0.03);
}

}  // namespace
}  // namespace arboc::test

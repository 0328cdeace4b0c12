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
}

}  // namespace
}  // namespace arboc::test

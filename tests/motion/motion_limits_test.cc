// What a motion keeps to besides its contacts: spheres that do not meet, forces along a hand's own
// axes.
#include <posture/build.h>
#include <unit/nlp_support.h>

#include "motion/motion_support.h"

namespace arboc::test {
namespace {

motion::Task plane_motion() {
  motion::Task t = motion_task("nine_dof_trial3_obj3");
  t.duration = 1;  // dynamics that count
  return t;
}

double nearest(const motion::Task& t, const motion::Result& r) {
  const auto pairs = posture::pairs(t.start.posture);
  double least = 1;
  for (Eigen::Index k = 0; k < r.samples.t.size(); ++k) {
    const VectorXd q = r.samples.q.row(k).transpose();
    for (const double gap : posture::gaps(t.start.posture, posture::model(t.model), pairs,
                                          {q.data(), q.data() + q.size()}))
      least = std::min(least, gap);
  }
  return least;
}

/// A post stands where the trunk would go: it goes round it.
TEST(MotionLimits, SpheresDoNotMeet) {
  motion::Task t = plane_motion();
  posture::Sphere trunk, post;
  trunk.name = trunk.part = "trunk";
  trunk.frame = "trunk";
  trunk.radius = 0.02;
  post.name = post.part = "post";
  post.centre = {0.01, 0, 0};
  post.radius = 0.02;
  const motion::Result free = solve_motion(t);
  t.start.posture.collision.spheres = {trunk, post};
  EXPECT_LT(nearest(t, free), -0.01);
  const motion::Result r = solve_motion(t);
  expect_moves(t, r);
  EXPECT_GE(nearest(t, r), -t.tolerance.drift);
  EXPECT_NEAR(r.audit.overlap.value, std::max(0.0, -nearest(t, r)), 1e-12);
  EXPECT_LT(nearest(t, r), 1e-3) << "it goes as near as it may";
  // At frames they are apart to what the solver leaves of rows, 1e-8 of squares of 0.04 m.
  const VectorXd frames = r.motion->q.basis().greville();
  const auto pairs = posture::pairs(t.start.posture);
  for (Eigen::Index k = 3; k < frames.size() - 3; ++k) {
    const VectorXd q = r.motion->q(frames[k]);
    EXPECT_GE(posture::gaps(t.start.posture, posture::model(t.model), pairs,
                            {q.data(), q.data() + q.size()})[0],
              -1e-7);
  }
}

/// The audit sees what frames do not ask for.
TEST(MotionLimits, SpheresThatMeetFailTheAudit) {
  motion::Task t = plane_motion();
  const motion::Result free = solve_motion(t);
  posture::Sphere trunk, post;
  trunk.name = trunk.part = "trunk";
  trunk.frame = "trunk";
  trunk.radius = post.radius = 0.02;
  post.name = post.part = "post";
  post.centre = {0.01, 0, 0};
  t.start.posture.collision.spheres = {trunk, post};
  const motion::Audit a = motion::audit(t, posture::model(t.model), free.samples);
  EXPECT_GT(a.overlap.value, 0.01);
  EXPECT_EQ(a.overlap.where, "trunk, post");
  EXPECT_FALSE(a.passes(t.tolerance));
}

/// A hand that may push more than it may pull, along its own axes.
motion::Task own_axes_motion() {
  motion::Task t = plane_motion();
  for (posture::Task* at : {&t.start.posture, &t.end.posture}) {
    at->contacts[0].own_axes = true;
    at->contacts[0].force[0] = {-50, 450};
  }
  return t;
}

TEST(MotionLimits, ForcesAlongAHandsOwnAxesKeepTheirLimits) {
  const motion::Task t = own_axes_motion();
  const motion::Model& model = posture::model(t.model);
  const motion::Result r = solve_motion(t);
  expect_moves(t, r);
  const int hand = 12 * model.robot.frame(t.start.posture.contacts[0].frame);
  double most = -1e9, world = -1e9;
  for (Eigen::Index k = 0; k < r.samples.t.size(); ++k) {
    const VectorXd placement = r.samples.placements.row(k).segment<12>(hand).transpose();
    const Eigen::Vector3d f = r.samples.reactions.row(k).head<3>().transpose();
    const Eigen::Vector3d own = nlp::Placement(placement.data()).R.transpose() * f;
    EXPECT_GE(own.x(), -50 - 1e-6);
    EXPECT_LE(own.x(), 450 + 1e-6);
    most = std::max(most, own.x());
    world = std::max(world, f.x());
  }
  EXPECT_GT(most, 440) << "the limit counts";
  EXPECT_GT(std::fabs(most - world), 10) << "its axes are not those of the world";
}

/// Rows that turn forces into the world's axes, against differences.
TEST(MotionLimits, OwnAxesHaveExactDerivatives) {
  motion::Task t = own_axes_motion();
  t.curves.control_points = 9;
  t.start.posture.contacts[0].point = t.end.posture.contacts[0].point = {0.01, -0.02, 0};
  const motion::Model& model = posture::model(t.model);
  posture::Result start, end;
  const motion::Ends ends = motion::predict_ends(t, model, start, end);
  const motion::Motion guess = motion::first_guess(t, ends);
  motion::Built built = motion::build(model, {{&t, &ends, &guess}});
  expect_exact_near(*built.nlp, vector_of(motion::variables_of(built, {guess})), 0.1);
}

}  // namespace
}  // namespace arboc::test

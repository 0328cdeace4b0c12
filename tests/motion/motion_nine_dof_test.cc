// The plane model of [Thesis] section 6.2: eight trials, five objectives.
#include "motion/motion_support.h"

namespace arboc::test {
namespace {

std::string name(int trial, int objective) {
  return "nine_dof_trial" + std::to_string(trial) + "_obj" + std::to_string(objective);
}

TEST(NineDofMotion, AllCasesSolveAndPassTheAudit) {
  for (int trial = 1; trial <= 8; ++trial) {
    for (int objective = 1; objective <= 5; ++objective) {
      const motion::Task t = motion_task(name(trial, objective));
      const motion::Result r = solve_motion(t);
      expect_moves(t, r);
      EXPECT_GE(r.audit.instants, 401);
    }
  }
}

/// In the document more than five frames with dynamics had no solution.
TEST(NineDofMotion, FortyFramesAreNoTrouble) {
  for (const int trial : {7, 8}) {
    const motion::Task t = motion_task(name(trial, 4));
    const motion::Result r = solve_motion(t);
    expect_moves(t, r);
    EXPECT_EQ(r.stages.back().contact_frames, trial == 7 ? 20 : 40);
  }
}

/// With more time the peak tends to that of motions at rest (in the document it did not).
TEST(NineDofMotion, PeakTorqueTendsToThatOfRestWithDuration) {
  std::vector<double> peaks;
  for (const double duration : {5.0, 30.0, 100.0, 300.0}) {
    motion::Task t = motion_task("nine_dof_trial3_obj4");
    t.duration = duration;
    const motion::Result r = solve_motion(t);
    expect_moves(t, r);
    peaks.push_back(r.audit.largest_normalised);
    // Never below what the postures at the ends ask for.
    EXPECT_GE(peaks.back(), r.start.max_normalised_torque - 1e-9);
  }
  EXPECT_NEAR(peaks[1], peaks[3], 1e-3 * peaks[3]);
  EXPECT_NEAR(peaks[2], peaks[3], 1e-4 * peaks[3]);
}

/// Newton's law for the whole body: sum of forces = weight + m * acceleration of its centre.
TEST(NineDofMotion, ForcesCarryTheBody) {
  motion::Task t = motion_task("nine_dof_trial3_obj3");
  t.duration = 5;
  const motion::Result r = solve_motion(t);
  expect_moves(t, r);
  for (Eigen::Index k = 0; k < r.samples.t.size(); ++k)
    // The body moves by 0.2 m in 5 s: below 0.1 m/s^2 of 74 kg.
    EXPECT_NEAR(r.samples.reactions(k, 1) + r.samples.reactions(k, 7), 74 * 9.81,
                7.4 + t.tolerance.force);
}

/// Reactions alone, of the motion that was found, are those that were found with it.
TEST(NineDofMotion, ReactionsOfTheMotionAreTheSame) {
  motion::Task t = motion_task("nine_dof_trial3_obj3");
  t.duration = 5;
  const motion::Result both = solve_motion(t);
  expect_moves(t, both);
  expect_same_reactions(t, both);
}

}  // namespace
}  // namespace arboc::test

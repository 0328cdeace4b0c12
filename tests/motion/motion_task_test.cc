// Task files of motions: what is wrong is said with its place.
#include <fstream>

#include "common/task_file.h"
#include "motion/motion_support.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

const std::string kEnds =
    "[start]\nbase = \"" ARBOC_SOURCE_DIR
    "/apps/posture/tasks/nine_dof_trial1_obj3.toml\"\n"
    "[end]\nbase = \"" ARBOC_SOURCE_DIR "/apps/posture/tasks/nine_dof_trial3_obj3.toml\"\n";

std::string complaint(const std::string& text) {
  const TempDir folder;
  const std::string path = std::string(folder.path()) + "/task.toml";
  std::ofstream(path) << text;
  try {
    motion::read_plan(path);
  } catch (const study::TaskError& e) {
    return e.what();
  }
  return "";
}

TEST(MotionTask, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(complaint(kEnds), "");
  EXPECT_NE(complaint("duration = 2\n").find("start is missing"), std::string::npos);
  EXPECT_NE(complaint("duration = -1\n" + kEnds).find("duration is not above 0"),
            std::string::npos);
  EXPECT_NE(complaint("durations = 1\n" + kEnds).find("durations"), std::string::npos);
  EXPECT_NE(complaint(kEnds + "[curves]\ncontrol_points = 4\n").find("control_points"),
            std::string::npos);
  EXPECT_NE(complaint(kEnds + "[curves]\ncontrol_points = 4\n").find(":6:"), std::string::npos);
  EXPECT_NE(complaint(kEnds + "[objective]\ntorque = -1\n").find("not a weight"),
            std::string::npos);
  EXPECT_NE(
      complaint("duration = 1\n" + kEnds + "[[via]]\nname = \"a\"\nframe = \"trunk\"\ntime = 3\n")
          .find("not between the ends"),
      std::string::npos);
}

TEST(MotionTask, StartAndEndHoldOnAlike) {
  const std::string hand = "[[end.contact]]\nname = \"left hand\"\n";
  EXPECT_EQ(complaint(kEnds + hand + "force = [0, 0, 0]\n"), "");
  for (const char* other : {"frame = \"trunk\"\n", "point = [0, 0, 0.1]\n",
                            "position = [-0.06, 0.18, 0]\n", "axes = \"own\"\n"})
    EXPECT_NE(complaint(kEnds + hand + other)
                  .find("contact 'left hand' does not hold the same point in the same place"),
              std::string::npos)
        << other;
  EXPECT_NE(complaint(kEnds + "[[end.contact]]\nname = \"nose\"\nframe = \"trunk\"\n")
                .find("not the same contacts"),
            std::string::npos);
}

TEST(MotionTask, PhasesFitTogether) {
  const std::string task = "nine_dof_trial3_obj3.toml\"\n",
                    first = "[[phase]]\nbase = \"" ARBOC_SOURCE_DIR "/apps/motion/tasks/" + task;
  EXPECT_EQ(complaint(first + first), "");
  // Where the one before ends, with its contacts.
  EXPECT_EQ(complaint(first + "[[phase]]\nend.base = \"" ARBOC_SOURCE_DIR
                              "/apps/posture/tasks/nine_dof_trial1_obj3.toml\"\n"),
            "");
  EXPECT_NE(complaint(first + first + "start_velocity = { x = 1 }\n").find("start_velocity"),
            std::string::npos);
  EXPECT_NE(complaint(first + first + "[[phase.start.contact]]\nname = \"left hand\"\n" +
                      "position = [-0.06, 0.18, 0]\n" + "[[phase.end.contact]]\n" +
                      "name = \"left hand\"\nposition = [-0.06, 0.18, 0]\n")
                .find("as in the phase before"),
            std::string::npos);
  EXPECT_NE(complaint(first + "[[phase]]\nbase = \"" ARBOC_SOURCE_DIR
                              "/apps/motion/tasks/santos_lean.toml\"\n")
                .find("not the same model"),
            std::string::npos);
  EXPECT_NE(complaint("start_velocity = \"any\"\n" + kEnds).find("start_velocity"),
            std::string::npos);
  EXPECT_NE(complaint("phase = []\n").find("no phase"), std::string::npos);
  EXPECT_THROW(motion_task("nine_dof_through"), study::TaskError);
}

TEST(MotionTask, WhatIsLetGoCarriesNothing) {
  const std::string base = "base = \"" ARBOC_SOURCE_DIR "/apps/motion/tasks/",
                    phases = "[[phase]]\n" + base + "santos_climb_phase.toml\"\n" + "[[phase]]\n" +
                             base + "santos_rung.toml\"\n";
  EXPECT_NE(complaint(phases).find("contact 'right foot' is let go"), std::string::npos);
}

TEST(MotionTask, WhatTakesHoldDoesNotMove) {
  const std::string base = "base = \"" ARBOC_SOURCE_DIR "/apps/motion/tasks/humanoid_",
                    step = "[[phase]]\n" + base + "step.toml\"\n",
                    both = "[[phase]]\n[phase.start]\n" + base + "walk_both.toml\"\n" +
                           "[phase.end]\n" + base + "walk_both.toml\"\n";
  EXPECT_EQ(complaint(step + both), "");
  EXPECT_EQ(complaint(step + "end_velocity = { left_knee = 0.1 }\n" + both), "");
  EXPECT_NE(complaint(step + "end_velocity = \"any\"\n" + both).find("'right foot' is new"),
            std::string::npos);
}

TEST(MotionTask, PosturesHaveTheObjectiveOfTheMotionUnlessTheirOwn) {
  const motion::Task t = motion_task("nine_dof_trial3_obj2");
  EXPECT_EQ(t.start.posture.objective.torque, 1);
  EXPECT_EQ(t.start.posture.objective.normalised, 0);
  EXPECT_EQ(motion_task("santos_lean").start.posture.objective.normalised, 1);
}

}  // namespace
}  // namespace arboc::test

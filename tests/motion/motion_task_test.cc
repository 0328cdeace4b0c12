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
    motion::read_task(path);
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

TEST(MotionTask, PosturesHaveTheObjectiveOfTheMotionUnlessTheirOwn) {
  const motion::Task t = motion_task("nine_dof_trial3_obj2");
  EXPECT_EQ(t.start.posture.objective.torque, 1);
  EXPECT_EQ(t.start.posture.objective.normalised, 0);
  EXPECT_EQ(motion_task("santos_lean").start.posture.objective.normalised, 1);
}

}  // namespace
}  // namespace arboc::test

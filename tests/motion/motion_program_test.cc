// The program: files, exit statuses, interruption.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace arboc::test {
namespace {

const std::string kTasks = ARBOC_SOURCE_DIR "/apps/motion/tasks/";

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(MotionProgram, WritesWhatItFound) {
  const TempDir folder;
  const std::string out = std::string(folder.path()) + "/new/folder";
  const Outcome run =
      run_program({MOTION_PROGRAM, kTasks + "nine_dof_trial3_obj3.toml", "-o", out});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("violation"), std::string::npos) << "a line an iteration";
  const std::filesystem::path at(out);
  const auto json = nlohmann::json::parse(content(at / "result.json"));
  EXPECT_EQ(json["status"], "optimal");
  EXPECT_TRUE(json["audit_passes"].get<bool>());
  for (const char* key : {"force_N", "moment_Nm", "drift_mm", "torque_excess"})
    EXPECT_TRUE(json["audit"].contains(key)) << key;
  EXPECT_GT(json["seconds"].get<double>(), 0);
  const std::string csv = content(at / "trajectory.csv");
  EXPECT_EQ(csv.substr(0, 4), "t,x,");
  EXPECT_GE(std::count(csv.begin(), csv.end(), '\n'), 402);
  EXPECT_EQ(std::count(csv.begin(), csv.begin() + static_cast<long>(csv.find('\n')), ','), 36);
}

TEST(MotionProgram, FailsLoudlyWhereTheAuditFails) {
  const TempDir folder;
  const std::string out = folder.path(), task = out + "/task.toml";
  std::ofstream(task) << "base = \"" << kTasks << "nine_dof_trial3_obj3.toml\"\n"
                      << "[tolerance]\ndrift = 1e-9\n";
  const Outcome run = run_program({MOTION_PROGRAM, task, "-o", out, "--quiet"});
  EXPECT_EQ(run.status, 5);
  EXPECT_NE(run.out.find("audit"), std::string::npos) << run.out;
}

TEST(MotionProgram, ExitStatuses) {
  const TempDir folder;
  EXPECT_EQ(run_program({MOTION_PROGRAM}).status, 1);
  EXPECT_EQ(run_program({MOTION_PROGRAM, "nowhere.toml", "-o", folder.path()}).status, 2);
}

}  // namespace
}  // namespace arboc::test

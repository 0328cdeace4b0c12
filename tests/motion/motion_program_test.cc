// The program: files, exit statuses, interruption.
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

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
  EXPECT_NE(run.err.find("violated by"), std::string::npos) << "a line an iteration";
  const std::filesystem::path at(out);
  const auto json = nlohmann::json::parse(content(at / "result.json"));
  EXPECT_EQ(json["status"], "optimal");
  EXPECT_TRUE(json["audit_passes"].get<bool>());
  for (const char* key : {"force_N", "moment_Nm", "drift_mm", "torque_excess"})
    EXPECT_TRUE(json["audit"].contains(key)) << key;
  EXPECT_GT(json["seconds"].get<double>(), 0);
  for (const char* file :
       {"torques.svg", "balance.svg", "stroboscope.svg", "reaction_1.svg", "reaction_2.svg",
        "motion.glb", "motion.mot", "torques.sto", "reactions.mot", "frames.trc"})
    EXPECT_GT(content(at / file).size(), 1000U) << file;
  EXPECT_NE(content(at / "index.html").find("Torques over their limits"), std::string::npos);
  const std::string csv = content(at / "trajectory.csv");
  EXPECT_EQ(csv.substr(0, 4), "t,x,");
  EXPECT_GE(std::count(csv.begin(), csv.end(), '\n'), 402);
  EXPECT_EQ(std::count(csv.begin(), csv.begin() + static_cast<long>(csv.find('\n')), ','), 36);
}

TEST(MotionProgram, GoesOnFromAResult) {
  const TempDir folder;
  const std::string out = folder.path(), task = kTasks + "nine_dof_trial3_obj3.toml";
  ASSERT_EQ(run_program({MOTION_PROGRAM, task, "-o", out, "-q"}).status, 0);
  const auto first = nlohmann::json::parse(content(out + "/result.json"));
  const auto again = [&](const std::vector<std::string>& more) {
    std::vector<std::string> line{MOTION_PROGRAM,      task, "-o", out + "/again", "-q", "--from",
                                  out + "/result.json"};
    line.insert(line.end(), more.begin(), more.end());
    EXPECT_EQ(run_program(line).status, 0);
    return nlohmann::json::parse(content(out + "/again/result.json"));
  };
  const double objective = first["stages"].back()["objective"];
  EXPECT_NEAR(again({})["stages"].back()["objective"].get<double>(), objective, 1e-6);
  // The motion is kept: only its reactions are looked for.
  const auto reactions = again({"--reactions-only"});
  EXPECT_EQ(reactions["curves"]["q"]["control_points"], first["curves"]["q"]["control_points"]);
  // Itself against itself.
  const Outcome same = run_program({COMPARE_MOTIONS, out + "/motion.mot", out + "/motion.mot"});
  EXPECT_EQ(same.status, 0) << same.err;
  EXPECT_NE(same.out.find("q3"), std::string::npos);
  EXPECT_EQ(run_program({COMPARE_MOTIONS, out + "/motion.mot", "nowhere.csv"}).status, 2);
}

TEST(MotionProgram, PhasesAreOneMotion) {
  const TempDir folder;
  const std::string out = folder.path(), task = kTasks + "nine_dof_through.toml";
  const Outcome run = run_program({MOTION_PROGRAM, task, "-o", out});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("1-2 objective"), std::string::npos) << "which phases it is at";
  const auto json = nlohmann::json::parse(content(out + "/result.json"));
  EXPECT_EQ(json["status"], "optimal");
  EXPECT_NEAR(json["duration_s"].get<double>(), 1.2, 1e-12);
  ASSERT_EQ(json["phases"].size(), 2U);
  double drift = 0;
  for (const auto& phase : json["phases"]) {
    EXPECT_EQ(phase["status"], "optimal");
    EXPECT_TRUE(phase["audit_passes"].get<bool>());
    drift = std::max(drift, phase["audit"]["drift_mm"].get<double>());
  }
  EXPECT_EQ(json["audit"]["drift_mm"].get<double>(), drift);
  const std::string csv = content(out + "/trajectory.csv");
  EXPECT_GE(std::count(csv.begin(), csv.end(), '\n'), 2 * 401);
  EXPECT_GT(content(out + "/index.html").size(), 1000U);
  for (const std::string more : {"--quiet", "--reactions-only"})
    EXPECT_EQ(run_program({MOTION_PROGRAM, task, "-o", out + "/again", "--from",
                           out + "/result.json", more})
                  .status,
              0);
  // Not of so many phases.
  EXPECT_EQ(run_program({MOTION_PROGRAM, kTasks + "santos_climb.toml", "-o", out + "/other",
                         "--from", out + "/result.json"})
                .status,
            2);
}

TEST(MotionProgram, AVelocityThatContactsForbidIsAMistakeInTheTask) {
  const TempDir folder;
  const std::string out = folder.path(), task = out + "/task.toml";
  std::ofstream(task) << "base = \"" << kTasks << "nine_dof_trial3_obj3.toml\"\n"
                      << "end_velocity = { x = 0.3, y = 0, q2 = 0, q3 = 0, q4 = 0, q5 = 0 }\n";
  const Outcome run = run_program({MOTION_PROGRAM, task, "-o", out, "--quiet"});
  EXPECT_EQ(run.status, 2);
  EXPECT_EQ(run.err.find(task + ": error: end_velocity: contacts do not allow it: 'right hand' "),
            0U)
      << run.err;
}

TEST(MotionProgram, AResultWithOtherContactsIsNoStart) {
  const TempDir folder;
  const std::string out = folder.path();
  ASSERT_EQ(
      run_program({MOTION_PROGRAM, kTasks + "nine_dof_trial3_obj3.toml", "-o", out, "-q"}).status,
      0);
  auto json = nlohmann::json::parse(content(out + "/result.json"));
  json["curves"]["reactions"]["control_points"].erase(0);
  std::ofstream(out + "/less.json") << json;
  json["contacts"] = {"nose"};
  std::ofstream(out + "/other.json") << json;
  for (const auto& [file, said] : {std::pair("less.json", "curves"), {"other.json", "contacts"}}) {
    const Outcome run = run_program({MOTION_PROGRAM, kTasks + "nine_dof_trial3_obj3.toml", "-o",
                                     out, "-q", "--from", out + "/" + file});
    EXPECT_EQ(run.status, 2) << file;
    EXPECT_NE(run.err.find(said), std::string::npos) << run.err;
  }
}

TEST(MotionProgram, InterruptedItWritesTheBestSoFar) {
  const TempDir folder;
  const std::string out = folder.path();
  Running run({MOTION_PROGRAM, kTasks + "santos_lean_squat.toml", "-o", out});
  std::this_thread::sleep_for(std::chrono::milliseconds(1200));
  run.signal(SIGINT);
  const Outcome outcome = run.wait();
  EXPECT_EQ(outcome.status, 5) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(content(out + "/result.json"))["status"], "stopped");
  EXPECT_GT(content(out + "/trajectory.csv").size(), 1000U);
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

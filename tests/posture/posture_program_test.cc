// The program: files, exit statuses.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace arboc::test {
namespace {

const std::string kTasks = ARBOC_SOURCE_DIR "/apps/posture/tasks/";

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(PostureProgram, WritesWhatItFound) {
  const TempDir folder;
  const std::string out = std::string(folder.path()) + "/new/folder";
  const Outcome run = run_program({POSTURE_PROGRAM, kTasks + "nine_dof_trial1_obj3.toml", "-o", out,
                                   "--starts", "3", "--move", "0.01", "0", "0"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("3 of 3 starts solved"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("in Hessians of them"), std::string::npos);
  const std::filesystem::path at(out);
  const auto json = nlohmann::json::parse(content(at / "result.json"));
  EXPECT_EQ(json["status"], "optimal");
  for (const char* key : {"reason", "objective", "kkt_error", "max_violation",
                          "max_normalised_torque", "iterations", "seconds"})
    EXPECT_TRUE(json.contains(key)) << key;
  EXPECT_EQ(json["q"].size(), 9U);
  EXPECT_EQ(json["tau"].size(), 9U);
  EXPECT_EQ(json["reactions"].size(), 2U);
  EXPECT_EQ(json["starts"].size(), 3U);
  EXPECT_EQ(json["again"]["status"], "optimal");
  EXPECT_LT(json["kkt_error"].get<double>(), 1e-7);
  const std::string page = content(at / "index.html");
  EXPECT_NE(page.find("class=\"bone\""), std::string::npos);
  EXPECT_NE(page.find("class=\"force\""), std::string::npos);
  EXPECT_NE(page.find("class=\"bar\""), std::string::npos);
  const std::string csv = content(at / "coordinates.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 10);
}

TEST(PostureProgram, TheSameTaskGivesTheSameNumbers) {
  const TempDir folder;
  std::string csv[2];
  for (int k = 0; k < 2; ++k) {
    const std::string out = std::string(folder.path()) + std::to_string(k);
    run_program(
        {POSTURE_PROGRAM, kTasks + "nine_dof_trial3_obj2.toml", "-o", out, "--starts", "2"});
    csv[k] = content(std::filesystem::path(out) / "coordinates.csv");
    std::filesystem::remove_all(out);
  }
  EXPECT_FALSE(csv[0].empty());
  EXPECT_EQ(csv[0], csv[1]);
}

TEST(PostureProgram, ExitStatusSaysHowItWent) {
  const TempDir folder;
  const std::string out = std::string(folder.path());
  const auto status = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), POSTURE_PROGRAM);
    return run_program(arguments).status;
  };
  EXPECT_EQ(status({}), 1);
  EXPECT_EQ(status({"--help"}), 0);
  EXPECT_EQ(status({"no_such_file.toml", "-o", out}), 2);
  EXPECT_EQ(status({kTasks + "nine_dof_trial1_obj3.toml", "-o", "/proc/none", "--starts", "1"}), 3);
  EXPECT_EQ(status({kTasks + "nine_dof_trial4_obj2.toml", "-o", out, "--starts", "1"}), 5);
}

}  // namespace
}  // namespace arboc::test

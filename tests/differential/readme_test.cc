// The commands that README.md shows in fenced blocks run as they stand, but into another folder.
#include <gtest/gtest.h>

#include <fstream>

#include "support/run_program.h"

namespace arboc::test {
namespace {

std::vector<std::string> commands(const std::string& word) {
  std::vector<std::string> found;
  std::ifstream page(ARBOC_SOURCE_DIR "/README.md");
  bool fenced = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("```")) fenced = line == "```sh";
    if (!fenced || !line.starts_with("arboc " + word + " models/")) continue;
    found.push_back(line);
    while (line.ends_with("\\") && std::getline(page, line)) found.back() += "\n" + line;
  }
  return found;
}

Outcome run(const std::string& command, const std::string& folder) {
  RunOptions options;
  options.folder = folder;
  return run_program({"bash", "-c",
                      "arboc() { \"" + arboc_command({})[0] + "\" \"$@\"; }\nln -sfn " +
                          ARBOC_SOURCE_DIR "/models models\n" + command},
                     options);
}

TEST(Readme, CompileCommandsWriteTheFolder) {
  const std::vector<std::string> all = commands("compile");
  EXPECT_GE(all.size(), 3u);
  for (const std::string& command : all) {
    const TempDir folder;
    const Outcome outcome = run(command, folder.path());
    EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "generated/ur5/ur5.hpp")) << command;
  }
}

TEST(Readme, EvalCommandsGiveTheSameForces) {
  const TempDir folder;
  write_text(folder / "states.csv", "0.1,-0.2,0.3,-0.4,0.5,-0.6\n1,2,3,4,5,6\n");
  const std::vector<std::string> all = commands("eval");
  ASSERT_EQ(all.size(), 2u);
  for (const std::string& command : all) {
    const Outcome outcome = run(command, folder.path());
    EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
  }
  const auto torques = numbers(read_text(folder / "torques.csv"));
  const auto same = numbers(read_text(folder / "the_same.csv"));
  ASSERT_EQ(torques.size(), 2u);
  ASSERT_EQ(same.size(), 2u);
  for (size_t k = 0; k < 2; ++k)
    for (size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(same[k].at(i), torques[k].at(i), 1e-12);  // of some 60 N m
}

}  // namespace
}  // namespace arboc::test

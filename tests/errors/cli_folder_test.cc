// The folders that bin/arboc leaves behind: the product, whole or not at all, and nothing else.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <set>
#include <thread>

#include "support/run_program.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;

const std::string kUr5 = ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf";
const std::string kPendulum = ARBOC_SOURCE_DIR "/models/double_pendulum/double_pendulum.urdf";

/// Paths below `folder`, directories with a slash.
std::set<std::string> tree_of(const std::string& folder) {
  std::set<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    paths.insert(fs::relative(entry.path(), folder).string() + (entry.is_directory() ? "/" : ""));
  return paths;
}

Outcome compile(const std::string& out, const std::string& functions,
                const std::vector<std::string>& more = {}) {
  std::vector<std::string> command{"compile", kPendulum, "-o", out, "--functions", functions};
  command.insert(command.end(), more.begin(), more.end());
  return run_arboc(command);
}

TEST(CliFolder, HoldsTheProductAndNothingElse) {
  const TempDir folder;
  const Outcome outcome = compile(folder / "a/b", "rnea");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with((folder / "a/b") + "/double_pendulum\n")) << outcome.out;
  EXPECT_EQ(
      tree_of(folder / "a/b"),
      (std::set<std::string>{
          "double_pendulum/", "double_pendulum/CMakeLists.txt", "double_pendulum/arboc/",
          "double_pendulum/arboc/angles.hpp", "double_pendulum/arboc/batch.hpp",
          "double_pendulum/arboc/lanes.hpp", "double_pendulum/arboc/math.hpp",
          "double_pendulum/arboc/pack.hpp", "double_pendulum/arboc/pack_math.hpp",
          "double_pendulum/arboc/rows.hpp", "double_pendulum/arboc/scalar.hpp",
          "double_pendulum/arboc/team.hpp", "double_pendulum/double_pendulum.hpp",
          "double_pendulum/double_pendulum_batch.hpp", "double_pendulum/double_pendulum_raw.hpp",
          "double_pendulum/double_pendulum_rnea.hpp",
          "double_pendulum/double_pendulum_rnea_double.cpp",
          "double_pendulum/double_pendulum_selftest.cpp", "double_pendulum/manifest.json"}));
}

TEST(CliFolder, SecondRunReplacesItsFilesAndKeepsOthers) {
  const TempDir folder;
  ASSERT_EQ(compile(folder.path(), "rnea,crba").status, 0);
  const std::string product = folder / "double_pendulum/";
  const std::string rnea = read_text(product + "double_pendulum_rnea.hpp");
  write_text(product + "double_pendulum_rnea.hpp", "edited");
  write_text(product + "notes.txt", "mine");
  write_text(folder / "double_pendulum.txt", "mine");

  ASSERT_EQ(compile(folder.path(), "rnea,gravity").status, 0);
  EXPECT_EQ(read_text(product + "double_pendulum_rnea.hpp"), rnea);
  EXPECT_TRUE(fs::exists(product + "double_pendulum_gravity.hpp"));
  EXPECT_FALSE(fs::exists(product + "double_pendulum_crba.hpp"));
  EXPECT_FALSE(fs::exists(product + "double_pendulum_crba_double.cpp"));
  EXPECT_EQ(read_text(product + "notes.txt"), "mine");
  EXPECT_EQ(read_text(folder / "double_pendulum.txt"), "mine");
  for (const auto& entry : fs::directory_iterator(folder.path()))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
}

TEST(CliFolder, OldManifestsRemoveNothingElsewhere) {
  const TempDir folder;
  ASSERT_EQ(compile(folder.path(), "rnea").status, 0);
  const std::string product = folder / "double_pendulum/";
  write_text(folder / "victim", "mine");
  write_text(product + "victim", "mine");
  const std::string outside = folder / "victim";
  for (const std::string& manifest :
       {R"({"files": {"../victim": "", ")" + outside +
            R"(": "", "": "", ".": "", "x/../victim": ""}})",
        std::string("not json"), std::string("[]"), std::string(R"({"files": ["victim"]})"),
        std::string(R"({"files": 1})")}) {
    write_text(product + "manifest.json", manifest);
    const Outcome outcome = compile(folder.path(), "rnea");
    EXPECT_EQ(outcome.status, 0) << manifest << outcome.err;
    EXPECT_EQ(read_text(outside), "mine") << manifest;
    EXPECT_EQ(read_text(product + "victim"), "mine") << manifest;
  }
}

TEST(CliFolder, SameInputGivesTheSameBytes) {
  const TempDir a, b;
  ASSERT_EQ(compile(a.path(), "all").status, 0);
  ASSERT_EQ(compile(b / "deeper", "all").status, 0);
  const std::set<std::string> files = tree_of(a.path());
  EXPECT_EQ(files, tree_of(b / "deeper"));
  for (const std::string& file : files)
    EXPECT_EQ(read_text(a / file), read_text((b / "deeper/") + file)) << file;
}

TEST(CliFolder, UnwritablePlacesExitWith3) {
  const TempDir folder;
  write_text(folder / "file", "");
  std::vector<std::string> places{folder / "file", folder / "file/below", "/proc/arboc"};
  if (::geteuid() != 0) {
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    places.push_back(folder / "locked");
  }
  for (const std::string& place : places) {
    const Outcome outcome = compile(place, "rnea");
    EXPECT_EQ(outcome.status, 3) << place;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.find(": error: cannot ") != std::string::npos) << outcome.err;
  }
  write_text(folder / "double_pendulum", "a file where the folder should be");
  const Outcome outcome = compile(folder.path(), "rnea");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_EQ(read_text(folder / "double_pendulum"), "a file where the folder should be");
}

TEST(CliFolder, NamesAreSanitised) {
  const TempDir folder;
  ASSERT_EQ(compile(folder / "out", "rnea", {"--name", "../x; y\n"}).status, 0);
  ASSERT_EQ(compile(folder / "out", "rnea", {"--name", "7"}).status, 0);
  ASSERT_EQ(compile(folder / "out", "rnea", {"--name", "class"}).status, 0);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / "out"))
    names.insert(entry.path().filename().string());
  EXPECT_EQ(names, (std::set<std::string>{"class_model", "m7", "x_y"}));
  EXPECT_EQ(tree_of(folder.path()).count("out/"), 1u);
}

/// Waits until the C++ compiler runs, then interrupts.
Outcome interrupt_while_compiling(const std::string& temporary) {
  RunOptions options;
  options.environment["TMPDIR"] = temporary;
  const std::string slow = temporary + "-c++";
  write_text(slow, "#!/bin/sh\ntouch " + temporary + "/started\nsleep 60\n");
  fs::permissions(slow, fs::perms::owner_all);
  Running arboc(arboc_command({"check", kUr5, "--functions", "rnea", "--cxx", slow}), options);
  for (int k = 0; k < 1000 && !fs::exists(temporary + "/started"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  arboc.signal(SIGINT);
  Outcome outcome = arboc.wait();
  fs::remove(temporary + "/started");
  fs::remove(slow);
  return outcome;
}

TEST(CliFolder, InterruptStopsTheCompilerAndLeavesNothing) {
  const TempDir folder;
  fs::create_directory(folder / "tmp");
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = interrupt_while_compiling(folder / "tmp");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_EQ(outcome.status, 130);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "interrupted\n");
  EXPECT_TRUE(tree_of(folder / "tmp").empty());
}

TEST(CliFolder, InterruptWhileReadingEndsTheProgram) {
  const TempDir folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(run_program({"mkfifo", pipe}).status, 0);
  RunOptions options;
  Running arboc(arboc_command({"inspect", pipe}), options);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // opening a pipe blocks
  arboc.signal(SIGINT);
  EXPECT_EQ(arboc.wait().status, 130);
}

}  // namespace
}  // namespace arboc::test

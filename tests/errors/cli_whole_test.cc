// Outputs are whole or not there: killed, interrupted, without room, without standard output; and
// what is not whole is recognised.
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "support/random.h"
#include "support/run_program.h"
#include "support/urdf_text.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;
using Texts = std::map<std::string, std::string>;

const std::string kUr5 = ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf";

/// Two programs for one folder: the second one replaces, adds and removes files.
const std::vector<std::vector<std::string>> kVersions = {
    {"--functions", "rnea,crba,fk,aba", "--snap", "0"},
    {"--functions", "rnea,gravity,nle,aba,fk", "--frames", "flange"}};

std::vector<std::string> compile_command(const std::string& out, int version) {
  std::vector<std::string> command{"compile", kUr5, "-o", out};
  const auto& options = kVersions[static_cast<size_t>(version)];
  command.insert(command.end(), options.begin(), options.end());
  return command;
}

Texts texts_of(const std::string& folder) {
  Texts texts;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      texts[fs::relative(entry.path(), folder).string()] = read_text(entry.path().string());
  return texts;
}

int check_folder(const std::string& folder) {
  return run_arboc({"check", "--folder", folder}).status;
}

/// The files of both versions, made without disturbance, and the seconds that it takes: the least
/// of several runs, for a busy machine may slow one down many times.
struct Whole {
  Texts files[2];
  double seconds = 1e9;
};
Whole whole_versions() {
  Whole whole;
  for (int version : {0, 1, 0, 1, 0, 1}) {
    const TempDir folder;
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(run_arboc(compile_command(folder.path(), version)).status, 0);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    whole.seconds = std::min(whole.seconds, taken.count());
    whole.files[version] = texts_of(folder / "ur5");
  }
  return whole;
}

/// Whether every file is one of the two versions, whole.
void expect_old_or_new(const std::string& folder, const Whole& whole) {
  for (const auto& [path, text] : texts_of(folder)) {
    bool known = false;
    for (const Texts& files : whole.files) {
      const auto file = files.find(path == "manifest.json.new" ? "manifest.json" : path);
      known = known || (file != files.end() && file->second == text);
    }
    EXPECT_TRUE(known) << path;
  }
}

class Stopped : public testing::TestWithParam<int> {};

TEST_P(Stopped, AtAnyTimeLeavesOldFilesOrWholeNewOnes) {
  const Whole whole = whole_versions();
  const TempDir folder;
  Random random(static_cast<std::uint64_t>(GetParam()));
  int fresh = 0, mixed = 0, stopped = 0, over_old = 0;
  for (const std::uint64_t seed : seeds(10)) {
    const int version = static_cast<int>(seed % 2);
    const bool existed = random.chance(0.7);
    if (existed)
      ASSERT_EQ(run_arboc(compile_command(folder.path(), 1 - version)).status, 0);
    else
      fs::remove_all(folder / "ur5");
    RunOptions options;
    Running run(arboc_command(compile_command(folder.path(), version)), options);
    // Half of them about the end, where the files are put in place.
    const double least = random.chance(0.5) ? 0.7 : 0;
    std::this_thread::sleep_for(
        std::chrono::duration<double>(random.uniform(least, 1.1) * whole.seconds));
    run.signal(GetParam());
    const int status = run.wait().status;
    // An interrupt in the first millisecond finds no handler yet.
    EXPECT_TRUE(status == 0 || status == -GetParam() || (GetParam() == SIGINT && status == 130))
        << status;
    stopped += status != 0;
    over_old += existed && status != 0;
    if (!fs::exists(folder / "ur5")) {
      ++fresh;
      EXPECT_FALSE(existed);
      EXPECT_NE(status, 0);
      continue;
    }
    expect_old_or_new(folder / "ur5", whole);
    const int checked = check_folder(folder / "ur5");
    mixed += checked != 0;
    if (checked != 0) {
      EXPECT_TRUE(existed);
      EXPECT_EQ(checked, 5);
      EXPECT_EQ(status, -SIGKILL);  // an interrupt waits until the files are there
    }
  }
  RecordProperty("stopped", stopped);
  RecordProperty("new_folder_absent", fresh);
  RecordProperty("recognised_as_mixed", mixed);
  EXPECT_GT(over_old, 0);
  ASSERT_EQ(run_arboc(compile_command(folder.path(), 0)).status, 0);
  EXPECT_EQ(check_folder(folder / "ur5"), 0);
  EXPECT_TRUE(texts_of(folder / "ur5") == whole.files[0]);
  for (const auto& entry : fs::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().filename(), "ur5");  // what killed runs left has been cleaned up
}
INSTANTIATE_TEST_SUITE_P(Signals, Stopped, testing::Values(SIGKILL, SIGINT),
                         [](const auto& at) { return at.param == SIGKILL ? "Kill" : "Int"; });

TEST(Whole, RunsAtTheSameTimeTakeTurns) {
  const Whole whole = whole_versions();
  const TempDir folder;
  {
    const RunOptions options;
    std::vector<std::unique_ptr<Running>> runs;
    for (int k = 0; k < 6; ++k)
      runs.push_back(
          std::make_unique<Running>(arboc_command(compile_command(folder.path(), k % 2)), options));
    for (const auto& run : runs) EXPECT_EQ(run->wait().status, 0);
  }
  const Texts now = texts_of(folder / "ur5");
  EXPECT_TRUE(now == whole.files[0] || now == whole.files[1]);
}

/// Runs a shell command in which $ARBOC stands for compile into `folder`.
Outcome in_shell(const std::string& command, const std::string& folder) {
  std::string arboc;
  for (const std::string& word : arboc_command(compile_command(folder, 0)))
    arboc += " '" + word + "'";
  RunOptions options;
  options.environment["ARBOC"] = arboc;
  return run_program({"sh", "-c", command}, options);
}

TEST(Whole, FilesThatMayNotGrowExitWith3) {
  const TempDir folder;
  const Outcome outcome = in_shell("ulimit -f 1 && eval exec $ARBOC", folder / "out");
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot write: File too large"), std::string::npos) << outcome.err;
  EXPECT_TRUE(fs::is_empty(folder / "out"));
}

TEST(Whole, AFullDiskExitsWith3AndKeepsTheOldFiles) {
  const TempDir folder;
  fs::create_directory(folder / "disk");
  if (::mount("none", (folder / "disk").c_str(), "tmpfs", 0, "size=200k") != 0)
    GTEST_SKIP() << "mounting is not allowed here";
  const std::string out = folder / "disk";
  const Outcome first = run_arboc({"compile", kUr5, "-o", out, "--functions", "gravity"});
  const Texts before = texts_of(out);
  const Outcome second = run_arboc({"compile", kUr5, "-o", out, "--functions", "all"});
  const Texts after = texts_of(out);
  ::umount(out.c_str());
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(second.status, 3);
  EXPECT_NE(second.err.find("No space left on device"), std::string::npos) << second.err;
  EXPECT_TRUE(before == after);
}

TEST(Whole, ClosedOrFullStandardOutputExitsWith3) {
  const TempDir folder;
  for (const char* command :
       {"eval exec $ARBOC >&-", "eval exec $ARBOC > /dev/full", "eval exec $ARBOC <&- >&- 2>&-",
        "eval exec $ARBOC >&- 2> /dev/full"}) {
    const Outcome outcome = in_shell(command, folder / "out");
    EXPECT_EQ(outcome.status, 3) << command << outcome.err;
    EXPECT_EQ(check_folder(folder / "out/ur5"), 0) << command;
  }
}

TEST(Whole, CheckFolderNamesWhatIsWrong) {
  const TempDir folder;
  ASSERT_EQ(run_arboc(compile_command(folder.path(), 0)).status, 0);
  const std::string product = folder / "ur5";
  const Outcome good = run_arboc({"check", kUr5, "--folder", product});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_NE(good.out.find(" files as the manifest lists them\n"), std::string::npos) << good.out;

  write_text(folder / "other.urdf", read_text(kUr5) + "\n");
  const Outcome other = run_arboc({"check", folder / "other.urdf", "--folder", product});
  EXPECT_EQ(other.status, 5);
  EXPECT_EQ(other.out, "the folder was made from another ur5.urdf\n");

  write_text(product + "/ur5_rnea.hpp", read_text(product + "/ur5_rnea.hpp") + " ");
  fs::remove(product + "/ur5.hpp");
  const Outcome bad = run_arboc({"check", "--folder", product});
  EXPECT_EQ(bad.status, 5);
  EXPECT_EQ(bad.out, "ur5.hpp: is missing\nur5_rnea.hpp: differs from the manifest\n");
  EXPECT_EQ(bad.err, "error: compile the model again\n");

  for (const char* manifest : {"", "[]", "{\"files\": {}}", "{\"files\": [1]}"}) {
    write_text(product + "/manifest.json", manifest);
    EXPECT_EQ(check_folder(product), 2) << manifest;
  }
  EXPECT_EQ(check_folder(folder / "nowhere"), 2);
  EXPECT_EQ(run_arboc({"check"}).status, 1);
}

TEST(Whole, DiagnosticsAsJsonHavePlaces) {
  const TempDir folder;
  write_text(folder / "bad.urdf",
             "<robot name='r'>\n<link name='a'/>\n<link name='a'/>\n<jiont/>\n</robot>");
  const Outcome outcome = run_arboc({"inspect", folder / "bad.urdf", "--diagnostics", "json"});
  EXPECT_EQ(outcome.status, 2);
  std::istringstream lines(outcome.err);
  std::vector<nlohmann::json> rows;
  for (std::string line; std::getline(lines, line);) rows.push_back(nlohmann::json::parse(line));
  ASSERT_EQ(rows.size(), 2u) << outcome.err;
  EXPECT_EQ(rows[0]["severity"], "error");
  EXPECT_EQ(rows[0]["file"], folder / "bad.urdf");
  EXPECT_EQ(rows[0]["line"], 3);
  EXPECT_EQ(rows[0]["column"], 1);
  EXPECT_EQ(rows[0]["element"], "link 'a'");
  EXPECT_EQ(rows[1]["severity"], "warning");
  EXPECT_EQ(rows[1]["line"], 4);

  const Outcome missing = run_arboc({"inspect", folder / "no\xFF.urdf", "--diagnostics=json"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(nlohmann::json::parse(missing.err)["severity"], "error");
  const Outcome still =
      run_arboc({"compile", ARBOC_SOURCE_DIR "/models/all_joints/all_joints.urdf", "-o",
                 folder / "out", "--functions", "fk", "--diagnostics=json", "--lock", "no=1"});
  EXPECT_EQ(still.status, 1);
}

TEST(Whole, FilesOfAnyNameCompile) {
  const TempDir folder;
  fs::copy_file(kUr5, folder / "ur\xFF\n5.urdf");
  const Outcome outcome =
      run_arboc({"compile", folder / "ur\xFF\n5.urdf", "-o", folder / "out", "--functions", "fk"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(run_arboc({"inspect", folder / "ur\xFF\n5.urdf", "--json"}).status, 0);
  EXPECT_EQ(check_folder(folder / "out/ur5"), 0);
}

/// `inspect` of a file with 512 MiB of address space.
int status_with_little_memory(const std::string& file) {
  RunOptions options;
  options.environment = {{"MODEL", file}, {"PROGRAM", arboc_command({}).at(0)}};
  return run_program({"sh", "-c", "ulimit -v 524288 && exec \"$PROGRAM\" inspect \"$MODEL\""},
                     options)
      .status;
}

TEST(Whole, AnyModelFileNeedsLessThan512MiB) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer reserves more";
#endif
  const TempDir folder;
  write_text(folder / "chain.urdf", chain_text(19999));
  EXPECT_EQ(status_with_little_memory(folder / "chain.urdf"), 0);
  write_text(folder / "errors.urdf",
             "<robot name='a'>" + repeated("<link name='a' nmae=''/>", 500000) + "</robot>");
  EXPECT_EQ(status_with_little_memory(folder / "errors.urdf"), 2);
  write_text(folder / "text.urdf", "<robot name='a'>" + repeated(" text", 12000000));
  EXPECT_EQ(status_with_little_memory(folder / "text.urdf"), 2);
  EXPECT_EQ(status_with_little_memory("/dev/zero"), 2);
}

TEST(Whole, AnyBadFileNeedsLessThan512MiB) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer reserves more";
#endif
  const std::string corpus = ARBOC_SOURCE_DIR "/../shared/bad-input/files";
  if (!fs::is_directory(corpus)) GTEST_SKIP() << "no " << corpus;
  for (const auto& entry : fs::directory_iterator(corpus)) {
    const int status = status_with_little_memory(entry.path().string());
    EXPECT_TRUE(status == 0 || status == 2) << entry.path() << ": " << status;
  }
}

}  // namespace
}  // namespace arboc::test

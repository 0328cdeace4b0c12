// The same bytes in every surrounding; and of the input only what it means matters.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "base/sha256.h"
#include "compile.h"
#include "emit/emit.h"
#include "frontend/urdf.h"
#include "fuzz/robot.h"
#include "support/random.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;

const std::string kQuadruped = ARBOC_SOURCE_DIR "/models/quadruped/quadruped.urdf";

std::map<std::string, std::string> product(const RunOptions& options, const std::string& model,
                                           const std::vector<std::string>& before = {}) {
  const TempDir folder;
  std::vector<std::string> command = before;
  for (const std::string& word :
       arboc_command({"compile", model, "-o", folder.path(), "--base", "floating", "--functions",
                      "dynamics", "--jacobian", "rnea.tau:q", "--hessian", "energy.T:v"}))
    command.push_back(word);
  const Outcome outcome = run_program(command, options);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder.path()).string()] = read_text(entry.path().string());
  return files;
}

TEST(SameBytes, InEveryLocaleTimeZoneFolderAndNumberOfProcessors) {
  const auto expected = product({}, kQuadruped);
  const TempDir folder;
  fs::copy_file(kQuadruped, folder / "quadruped.urdf");
  for (const char* locale : {"de_DE", "tr_TR"})  // decimal commas; i without a dot
    ASSERT_EQ(run_program({"localedef", "-i", locale, "-f", "UTF-8",
                           folder / (std::string(locale) + ".UTF-8")})
                  .status,
              0);
  for (const char* locale : {"C", "de_DE.UTF-8", "tr_TR.UTF-8", "C.UTF-8", "nonsense"}) {
    RunOptions options;
    options.environment = {
        {"LC_ALL", locale}, {"LANG", locale}, {"LOCPATH", folder.path()}, {"TZ", "Pacific/Apia"}};
    EXPECT_TRUE(product(options, kQuadruped) == expected) << locale;
  }
  RunOptions there;
  there.folder = folder.path();
  there.environment = {{"TZ", "Asia/Kolkata"}, {"HOME", "/nowhere"}, {"TMPDIR", "/nowhere"}};
  EXPECT_TRUE(product(there, "quadruped.urdf") == expected);
  EXPECT_TRUE(product(there, "./quadruped.urdf", {"taskset", "-c", "0"}) == expected);
}

/// What differs between two files that say the same: their hash and what is made of it.
std::string without_hashes(const std::string& text) {
  static const std::regex kHash("[0-9a-f]{64}|sha256 [0-9a-f]{16}");
  return std::regex_replace(text, kHash, "HASH");
}

TEST(SameBytes, WhateverWhiteSpaceCommentsAndOrderOfAttributes) {
  int different = 0, accepted = 0;
  for (const std::uint64_t seed : seeds(20)) {
    std::string bytes;
    Random random(seed);
    for (int k = 0; k < 200; ++k) bytes += static_cast<char>(random.integer(256));
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    fuzz::Bytes choices(data, bytes.size()), plain(nullptr, 0), odd(data, bytes.size());
    const fuzz::Robot robot = fuzz::robot_of(choices);
    Files files[2];
    std::string texts[2] = {fuzz::urdf_of(robot, plain), fuzz::urdf_of(robot, odd)};
    different += texts[0] != texts[1];
    for (int k = 0; k < 2; ++k) {
      CompileOptions options;
      options.requests = {{"rnea"}, {"fk"}};
      Diagnostics diagnostics;
      try {
        Model model = parse_urdf(texts[k], "robot.urdf", diagnostics);
        files[k] = emit(target(compile(model, options, diagnostics), options));
      } catch (const InputError&) {
      }
      for (auto& [path, text] : files[k]) text = without_hashes(text);
    }
    EXPECT_TRUE(files[0] == files[1]) << texts[0] << "\n" << texts[1];
    accepted += !files[0].empty();
  }
  EXPECT_GT(different, 0);
  EXPECT_GT(accepted, 10);
}

}  // namespace
}  // namespace arboc::test

// Emitted code on packs of states, by each compiler and with and without wide vectors.
#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/temp_dir.h"

namespace arboc::test {
namespace {

class EmittedLanes : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (run_program({GetParam(), "--version"}).status != 0)
      GTEST_SKIP() << GetParam() << " is not installed";
    emit("ur5", {"--functions", "rnea,crba,rnea_derivatives,aba"});
  }

  void emit(const std::string& model, const std::vector<std::string>& options) {
    std::vector<std::string> command{"compile",
                                     ARBOC_SOURCE_DIR "/models/" + model + "/" + model + ".urdf",
                                     "-o", folder_.path()};
    command.insert(command.end(), options.begin(), options.end());
    const Outcome outcome = run_arboc(command);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    sources_ += " " + model + "/*_double.cpp";
  }

  void emit_more() {
    emit("quadruped", {"--base", "floating", "--functions",
                       "rnea,crba,rnea_derivatives,aba,integrate,difference"});
    sources_ += " -DARBOC_ALL";
  }

  /// Compiles and runs emitted_lanes.cpp.
  void expect_agreement(const std::string& flags) {
    RunOptions options;
    options.folder = folder_.path();
    const Outcome outcome = run_program(
        {"sh", "-c",
         std::string(GetParam()) + " -std=c++17 -Wall -Wextra -Wpedantic -Wshadow -Werror " +
             flags + " -I. '" ARBOC_SOURCE_DIR "/tests/differential/emitted_lanes.cpp'" + sources_ +
             " -pthread -o lanes && ./lanes"},
        options);
    EXPECT_EQ(outcome.status, 0) << flags << "\n" << outcome.out << outcome.err.substr(0, 4000);
  }

  TempDir folder_;
  std::string sources_;
};

TEST_P(EmittedLanes, EqualSingleStatesOnThisMachine) {
  ASSERT_NO_FATAL_FAILURE(emit_more());
  expect_agreement("-O1 -march=native -fno-tree-vectorize");
}
TEST_P(EmittedLanes, EqualSingleStatesOnAnyMachine) {
  ASSERT_NO_FATAL_FAILURE(emit_more());
  expect_agreement("-O1");
}
TEST_P(EmittedLanes, HaveNoUndefinedBehaviour) {
  expect_agreement("-O0 -fsanitize=address,undefined -fno-sanitize-recover=all");
}
TEST_P(EmittedLanes, HaveNoRaces) { expect_agreement("-O1 -fsanitize=thread"); }

INSTANTIATE_TEST_SUITE_P(Compilers, EmittedLanes, testing::Values("g++", "clang++"),
                         [](const auto& c) { return std::string(c.param).substr(0, 1) + "xx"; });

}  // namespace
}  // namespace arboc::test

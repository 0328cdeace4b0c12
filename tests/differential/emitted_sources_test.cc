// The text of emitted folders: clean under strict warnings of each compiler at hand, on any
// scalar, side by side, and without undefined behaviour.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/run_program.h"

namespace arboc::test {
namespace {

namespace fs = std::filesystem;
using Command = std::vector<std::string>;

const Command kStrict = {"-std=c++17",   "-Wall",   "-Wextra",       "-Wpedantic", "-Wshadow",
                         "-Wconversion", "-Werror", "-fsyntax-only", "-isystem",   ARBOC_EIGEN};

/// Every function, with inputs of every kind.
const Command kEverything = {"--functions",
                             "all",
                             "--base",
                             "floating",
                             "--external-forces",
                             "tip,buoy",
                             "--parameters",
                             "gravity,masses",
                             "--joint-forces",
                             "friction,rotor",
                             "--jacobian",
                             "energy.T",
                             "--gradient",
                             "rnea.tau^2:v",
                             "--vjp",
                             "fk.placements",
                             "--hessian",
                             "energy.V:q,masses",
                             "--name",
                             "everything"};

bool installed(const std::string& compiler) {
  return run_program({compiler, "--version"}).status == 0;
}

/// Compiles a model of models/ to `folder`.
void emit(const TempDir& folder, const std::string& model, const Command& options = {}) {
  Command command{"compile", ARBOC_SOURCE_DIR "/models/" + model + "/" + model + ".urdf", "-o",
                  folder.path()};
  command.insert(command.end(), options.begin(), options.end());
  const Outcome outcome = run_arboc(command);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
}

void expect_success(const Command& command, const RunOptions& options = {}) {
  const Outcome outcome = run_program(command, options);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err.substr(0, 4000);
}

/// A shell's command line in `folder`.
void expect_success(const std::string& script, const TempDir& folder) {
  RunOptions options;
  options.folder = folder.path();
  expect_success(Command{"sh", "-c", script}, options);
}

void expect_clean(const std::string& compiler, const TempDir& folder, const std::string& source) {
  Command command{compiler};
  command.insert(command.end(), kStrict.begin(), kStrict.end());
  command.insert(command.end(), {"-I", folder.path(), source});
  SCOPED_TRACE(compiler + " " + fs::path(source).filename().string());
  expect_success(command);
}

class EmittedSources : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!installed(GetParam())) GTEST_SKIP() << GetParam() << " is not installed";
  }
};

/// Every file of every model: together in one unit, which is faster, and also shows that models
/// and functions do not disturb one another.
TEST_P(EmittedSources, OfAllModelsCompileWithoutWarnings) {
  const TempDir folder;
  for (const char* model : {"double_pendulum", "ur5", "arm7", "all_joints", "quadruped"})
    ASSERT_NO_FATAL_FAILURE(emit(folder, model));
  for (const char* model : {"all_joints", "humanoid"})
    ASSERT_NO_FATAL_FAILURE(
        emit(folder, model, {"--base", "floating", "--name", std::string(model) + "_floating"}));
  ASSERT_NO_FATAL_FAILURE(
      emit(folder, "double_pendulum", {"--functions", "all", "--name", "everything_small"}));
  ASSERT_NO_FATAL_FAILURE(emit(folder, "all_joints", kEverything));
  std::string all;
  for (const auto& model : fs::directory_iterator(folder.path())) {
    for (const auto& file : fs::directory_iterator(model.path())) {
      const std::string name = file.path().filename().string();
      const bool tests = name.ends_with("_selftest.cpp");
      if (name.ends_with(".hpp") || (name.ends_with(".cpp") && !tests))
        all += "#include \"" + file.path().string() + "\"\n";
      if (tests) expect_clean(GetParam(), folder, file.path().string());
    }
  }
  write_text(folder / "all.cpp", all);
  expect_clean(GetParam(), folder, folder / "all.cpp");
}

TEST_P(EmittedSources, EachHeaderStandsAlone) {
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(emit(folder, "ur5", {"--functions", "rnea,crba"}));
  for (const char* header :
       {"ur5.hpp", "ur5_raw.hpp", "ur5_batch.hpp", "ur5_rnea.hpp", "ur5_crba.hpp"}) {
    write_text(folder / "alone.cpp",
               std::string("#include <ur5/") + header + ">\n#include <ur5/" + header + ">\n");
    expect_clean(GetParam(), folder, folder / "alone.cpp");
  }
}

/// Fast arithmetic may cost digits, not more; the selftest allows 1e-11.
TEST_P(EmittedSources, PassTheirTestAtAnyOptimisation) {
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(emit(folder, "arm7", {"--functions", "fk,rnea,gravity,crba"}));
  for (const char* flags : {"-O0", "-O3 -march=native", "-Ofast -march=native"}) {
    SCOPED_TRACE(flags);
    expect_success(
        std::string(GetParam()) + " -std=c++17 " + flags + " arm7/*.cpp -o selftest && ./selftest",
        folder);
  }
}

INSTANTIATE_TEST_SUITE_P(Compilers, EmittedSources, testing::Values("g++", "clang++"),
                         [](const auto& c) { return std::string(c.param).substr(0, 1) + "xx"; });

/// Names that the C library, the generated code or its test could take for themselves.
TEST(EmittedNames, MayBeAny) {
  const TempDir folder;
  std::string all;
  for (const char* name :
       {"system", "index",     "j1",       "y0",     "gamma",  "random", "clock",
        "round",  "link",      "class",    "main",   "q",      "v",      "a",
        "tau",    "w",         "x0",       "M",      "T",      "rnea",   "report",
        "worst",  "failures",  "sparsity", "frame",  "Config", "Eigen",  "arboc",
        "detail", "v1",        "std",      "robot",  "12",     "é",      "raw",
        "load",   "parameter", "count",    "weight", "table",  "EOF"})
    ASSERT_NO_FATAL_FAILURE(
        emit(folder, "double_pendulum", {"--functions", "rnea,crba,gravity", "--name", name}));
  for (const auto& model : fs::directory_iterator(folder.path())) {
    const std::string stem = model.path() / model.path().filename();
    all +=
        "#include <unistd.h>\n#include \"" + stem + ".hpp\"\n#include \"" + stem + "_rnea.hpp\"\n";
    expect_clean("c++", folder, stem + "_selftest.cpp");
  }
  write_text(folder / "all.cpp", all);
  expect_clean("c++", folder, folder / "all.cpp");
}

/// Twelve frames of twelve numbers are no joint-space matrix.
TEST(EmittedEigen, PlacementsStandByRowsEvenWhereTheyAreSquare) {
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(emit(folder, "quadruped", {"--functions", "fk"}));
  write_text(folder / "rows.cpp",
             "#include <quadruped/quadruped.hpp>\n"
             "using Result = decltype(quadruped::fk(quadruped::Config()));\n"
             "static_assert(Result::RowsAtCompileTime == 12 && Result::IsRowMajor, \"\");\n");
  expect_clean("c++", folder, folder / "rows.cpp");
}

TEST(EmittedScalars, AreAny) {
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(emit(folder, "ur5"));
  ASSERT_NO_FATAL_FAILURE(emit(folder, "double_pendulum"));
  expect_success(
      "c++ -std=c++17 -O1 -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror -I. "
      "'" ARBOC_SOURCE_DIR
      "/tests/differential/emitted_scalars.cpp' ur5/ur5_aba_double.cpp "
      "ur5/ur5_crba_double.cpp ur5/ur5_fk_double.cpp ur5/ur5_rnea_double.cpp "
      "double_pendulum/double_pendulum_rnea_double.cpp -o scalars && ./scalars",
      folder);
}

/// `text` with `from` replaced by `to` everywhere.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

TEST_P(EmittedSources, OfAllFunctionsCompileForOtherScalars) {
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(emit(folder, "all_joints", kEverything));
  std::string all;
  for (const auto& file : fs::directory_iterator(folder / "everything")) {
    if (!file.path().filename().string().ends_with("_double.cpp")) continue;
    for (const std::string scalar : {"float", "long double"})
      all += replaced(replaced(read_text(file.path()), "<double>", "<" + scalar + ">"), "double*",
                      scalar + "*");
  }
  write_text(folder / "everything/scalars.cpp", all);
  expect_clean(GetParam(), folder, folder / "everything/scalars.cpp");
}

/// Links whose names say something else in C++, or the same once they are identifiers.
TEST(EmittedNames, OfLinksMayBeAny) {
  const TempDir folder;
  std::string robot = "<robot name='odd'><link name='base'/>", list;
  const std::vector<std::string> names = {"count", "names", "nominal", "EOF", "NAN",   "int",
                                          "fk",    "a b",   "a-b",     "a.b", "12",    "frame",
                                          "T",     "q",     "gravity", "raw", "linux", "sparsity"};
  for (const std::string& name : names) {
    robot += "<link name='" + name +
             "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' "
             "ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link><joint name='" +
             name + "' type='continuous'><parent link='base'/><child link='" + name +
             "'/><axis xyz='1 0 0'/></joint>";
    list += (list.empty() ? "" : ",") + name;
  }
  write_text(folder / "odd.urdf", robot + "</robot>");
  const Outcome outcome = run_arboc({"compile", folder / "odd.urdf", "-o", folder.path(),
                                     "--functions", "fk,rnea,gravity", "--external-forces", list,
                                     "--parameters", "gravity,masses,lengths"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  write_text(folder / "odd.cpp",
             "#include <cmath>\n#include <cstdio>\n#include <odd/odd.hpp>\n"
             "static_assert(odd::parameter::masses::count == 18, \"\");\n"
             "static_assert(odd::frame::a_b == 7 && odd::frame::a_b_3 == 9, \"\");\n"
             "static_assert(odd::load::count == 18 && odd::load::fk == 6, \"\");\n");
  expect_clean("c++", folder, folder / "odd.cpp");
}

TEST(EmittedCode, HasNoUndefinedBehaviour) {
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(emit(folder, "all_joints"));
  expect_success(
      "c++ -std=c++17 -O1 -fsanitize=address,undefined -fno-sanitize-recover=all "
      "all_joints/*.cpp -o selftest && ./selftest",
      folder);
}

}  // namespace
}  // namespace arboc::test

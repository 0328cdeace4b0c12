// What bin/arboc says and returns when it is asked for something wrong, and where it says it:
// results on standard output, everything else on standard error.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "support/run_program.h"

namespace arboc::test {
namespace {

using testing::TestWithParam;
using Arguments = std::vector<std::string>;

const std::string kUr5 = ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf";
const std::string kHumanoid = ARBOC_SOURCE_DIR "/models/humanoid/humanoid.urdf";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

struct Wrong {
  Arguments arguments;
  const char* message;  ///< part of it
};

TEST(CliStatus, UsageErrorsExitWith1) {
  const std::vector<Wrong> cases = {
      {{}, "a subcommand is required"},
      {{"frobnicate"}, "not expected: frobnicate"},
      {{"compile"}, "model is required"},
      {{"compile", kUr5}, "-o DIR (or --print STAGE) is required"},
      {{"compile", kUr5, "--print", "tokens"}, "--print"},
      {{"compile", kUr5, "-o", "x", "--functions", "rnea,nope"},
       "--functions: there is no function 'nope' (known are 'fk', 'rnea', 'gravity', 'statics', "
       "'nle', "},
      {{"compile", kUr5, "-o", "x", "--functions", ""}, "--functions"},
      {{"compile", kUr5, "-o", "x", "--functions", ","}, "--functions"},
      {{"inspect", kUr5, "--base", "loose"},
       "--base: expected file or fixed or floating, not 'loose'"},
      {{"inspect", kUr5, "--base", "1"}, "--base: expected file or fixed or floating, not '1'"},
      {{"inspect", kUr5, "--snap", "-1"}, "--snap: expected 0 to 0.1 (rad), not -1"},
      {{"inspect", kUr5, "--snap", "nan"}, "--snap: expected 0 to 0.1 (rad), not nan"},
      {{"inspect", kUr5, "--snap", "1"}, "--snap: expected 0 to 0.1 (rad), not 1"},
      {{"inspect", kUr5, "--lock", "elbo=1"},
       "--lock: there is no joint 'elbo' (did you mean 'elbow'?)"},
      {{"inspect", kUr5, "--lock", "knee=1"},
       "--lock: there is no joint 'knee' (known are 'shoulder_pan', 'shoulder_lift', 'elbow', "},
      {{"inspect", kUr5, "--lock", "elbow"}, "--lock: expected JOINT=VALUE[,VALUE...], not elbow"},
      {{"inspect", kUr5, "--lock", "elbow=much"}, "VALUE...], not elbow=much"},
      {{"inspect", kUr5, "--lock", "elbow=1,2"},
       "--lock: joint 'elbow' is revolute and has 1 coordinate, not 2"},
      {{"inspect", kUr5, "--lock", "flange_joint=1"}, "--lock: joint 'flange_joint' is fixed"},
      {{"inspect", kUr5, "--lock", "elbow=1", "--lock", "elbow=1"},
       "--lock: joint 'elbow' is given twice"},
      {{"inspect", kUr5, "--root", "forarm"},
       "--root: there is no link 'forarm' (did you mean 'forearm'?)"},
      {{"inspect", kUr5, "--tip", "flang"},
       "--tip: there is no link 'flang' (did you mean 'flange'?)"},
      {{"inspect", kUr5, "--root", "flange", "--tip", "forearm"},
       "--tip: link 'forearm' does not hang on link 'flange'"},
      {{"inspect", kUr5, "--tip", ""}, "--tip: the list is empty"},
      {{"compile", kUr5, "-o", "x", "--frames", "flange,flang"},
       "--frames: there is no link 'flang' (did you mean 'flange'?)"},
      {{"compile", kUr5, "-o", "x", "--frames", "flange,flange"},
       "--frames: link 'flange' is given twice"},
      {{"compile", kUr5, "-o", "x", "--jacobian", "rnea.tau:q,q"},
       "--jacobian rnea.tau:q,q: input 'q' is given twice"},
      {{"inspect", kUr5, "--max-dof", "0"}, "--max-dof"},
      {{"inspect", kUr5, "--max-dof", "many"}, "--max-dof"},
      {{"inspect", kUr5, "another.urdf"}, "another.urdf"},
      {{"eval", kUr5}, "--function F, or one derivative of an output; none is given"},
      {{"eval", kUr5, "--function", "nope"}, "--function: there is no function 'nope'"},
      {{"eval", kUr5, "--function", "rnea", "--engine", "steam"}, "--engine"},
      {{"eval", kUr5, "--function", "rnea", "--engine", "generic"},
       "--q (an input of rnea) is required"},
      {{"eval", kUr5, "--function", "gravity", "--output", "tau", "--q", "/dev/null"},
       "--output: gravity has no output 'tau' (known are 'g')"},
      {{"check", kUr5, "--states", "0"}, "--states"},
      {{"bench", kUr5, "--functions", "dynamics,rnae"},
       "--functions: there is no function 'rnae' (did you mean 'rnea'?)"},
      {{"bench", kUr5, "--lanes", "8,3"},
       "--lanes: expected 2, 4, 8 or 16, with f of floats, not 3"}};
  for (const Wrong& wrong : cases) {
    SCOPED_TRACE(wrong.message);
    const Outcome outcome = run_arboc(wrong.arguments);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("arboc: error: ")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, wrong.message)) << outcome.err;
  }
}

TEST(CliStatus, HelpIsAnAnswer) {
  const Outcome all = run_arboc({"--help"});
  EXPECT_EQ(all.status, 0);
  EXPECT_EQ(all.err, "");
  for (const char* command : {"compile", "inspect", "eval", "check", "bench"}) {
    EXPECT_TRUE(contains(all.out, std::string("  ") + command + " ")) << command;
    const Outcome outcome = run_arboc({command, "--help"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    for (const char* part : {"--base file|fixed|floating ", "--mimic follow|independent ",
                             "--joint-order file|alphabetical ", "--name NAME ", "--snap TOL ",
                             "[1e-09]", "--max-dof N ", "[512]"})
      EXPECT_TRUE(contains(outcome.out, part)) << command << ": " << part << "\n" << outcome.out;
    // The clutter of unnamed validators and types.
    for (const char* part : {" :", ":{", ":FLOAT", ":POSITIVE", "REQUIRED"})
      EXPECT_FALSE(contains(outcome.out, part)) << command << ": " << part << "\n" << outcome.out;
  }
  const Outcome version = run_arboc({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out, "0.1.0\n");
}

TEST(CliStatus, UnreadableModelsExitWith2) {
  const TempDir folder;
  write_text(folder / "not.urdf", "not xml");
  write_text(folder / "empty.urdf", "");
  for (const char* command : {"inspect", "compile", "check", "bench"}) {
    for (const std::string& file :
         {folder / "missing.urdf", folder.path(), folder / "not.urdf", folder / "empty.urdf"}) {
      SCOPED_TRACE(command + (" " + file));
      Arguments arguments{command, file};
      if (arguments[0] == "compile") arguments.insert(arguments.end(), {"-o", folder / "out"});
      const Outcome outcome = run_arboc(arguments);
      EXPECT_EQ(outcome.status, 2);
      EXPECT_EQ(outcome.out, "");
      EXPECT_TRUE(contains(outcome.err, file) && contains(outcome.err, "error: ")) << outcome.err;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

std::string with_massless_leaf() {
  return R"(<robot name="leaf"><link name="base"/><link name="arm"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><link name="tip"/>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="arm"/>
<axis xyz="0 0 1"/></joint>
<joint name="idle" type="continuous"><parent link="arm"/><child link="tip"/>
<axis xyz="0 0 1"/></joint></robot>)";
}

TEST(CliStatus, SingularInertiaIsRefusedByTheNameOfTheJoint) {
  const TempDir folder;
  write_text(folder / "leaf.urdf", with_massless_leaf());
  for (const std::string function : {"aba", "minv"}) {
    const Outcome outcome =
        run_arboc({"compile", folder / "leaf.urdf", "-o", folder / "out", "--functions", function});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(contains(outcome.err, "leaf.urdf: error: joint 'idle': ")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "warning: link 'tip'")) << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  const Outcome rest = run_arboc({"compile", folder / "leaf.urdf", "-o", folder / "out",
                                  "--functions", "fk,rnea,gravity,nle,crba"});
  EXPECT_EQ(rest.status, 0) << rest.err;
  EXPECT_TRUE(contains(rest.err, "warning: link 'tip'"));
  EXPECT_FALSE(contains(rest.out, "warning"));
}

TEST(CliStatus, ModelWithoutJointsIsInspectedButNotCompiled) {
  const TempDir folder;
  write_text(folder / "rock.urdf", R"(<robot name="rock"><link name="rock"/></robot>)");
  EXPECT_EQ(run_arboc({"inspect", folder / "rock.urdf"}).status, 0);
  EXPECT_EQ(run_arboc({"compile", folder / "rock.urdf", "--print", "model"}).status, 0);
  for (const Arguments& arguments :
       {Arguments{"compile", folder / "rock.urdf", "-o", folder / "out"},
        Arguments{"inspect", folder / "rock.urdf", "--ops"}}) {
    const Outcome outcome = run_arboc(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(contains(outcome.err, "no joint moves")) << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(CliStatus, MaxDofBindsTracingOnly) {
  const TempDir folder;
  EXPECT_EQ(run_arboc({"inspect", kUr5, "--max-dof", "5"}).status, 0);
  for (const Arguments& arguments :
       {Arguments{"compile", kUr5, "-o", folder / "out", "--max-dof", "5"},
        Arguments{"inspect", kUr5, "--ops", "rnea", "--max-dof", "5"},
        Arguments{"check", kUr5, "--max-dof", "5"}}) {
    const Outcome outcome = run_arboc(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(contains(outcome.err,
                         "6 degrees of freedom, more than the limit of 5 "
                         "(--max-dof 6 allows it)"))
        << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(CliStatus, FullDisksExitWith3) {
  for (const Arguments& arguments :
       {Arguments{"--help"}, Arguments{"--version"}, Arguments{"inspect", kUr5},
        Arguments{"inspect", kHumanoid, "--json"}, Arguments{"compile", kUr5, "--print", "model"},
        Arguments{"compile", kHumanoid, "--functions", "crba", "--print", "program"}}) {
    RunOptions options;
    options.output = "/dev/full";
    const Outcome outcome = run_arboc(arguments, options);
    EXPECT_EQ(outcome.status, 3) << arguments[0];
    EXPECT_TRUE(contains(outcome.err, "No space left on device")) << outcome.err;
  }
}

TEST(CliStatus, FailingCompilersExitWith4) {
  const TempDir folder;
  RunOptions options;
  options.environment["TMPDIR"] = folder.path();
  for (const char* compiler : {"false", "/nonexistent/c++"}) {
    const Outcome outcome =
        run_arboc({"check", kUr5, "--functions", "gravity", "--cxx", compiler}, options);
    EXPECT_EQ(outcome.status, 4);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(contains(outcome.err, "the C++ compiler failed")) << outcome.err;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(CliStatus, DisagreementExitsWith5) {
  // A compiler that gets one sign wrong, named by the environment.
  const TempDir folder;
  const std::string wrapper = folder / "c++";
  write_text(wrapper, R"(#!/bin/sh
for word in "$@"; do
  case $word in *_gravity_double.cpp) sed -i '/const T x/s/ + / - /' "${word%_double.cpp}.hpp" ;; esac
done
exec c++ "$@"
)");
  std::filesystem::permissions(wrapper, std::filesystem::perms::owner_all);
  RunOptions options;
  options.environment["CXX"] = wrapper;
  const Outcome outcome =
      run_arboc({"check", kUr5, "--functions", "gravity", "--cxxflags", "-O1"}, options);
  EXPECT_EQ(outcome.status, 5) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "WRONG")) << outcome.out;
  EXPECT_TRUE(contains(outcome.err, "disagrees")) << outcome.err;
}

TEST(CliStatus, AgreementExitsWith0) {
  const Outcome outcome = run_arboc(
      {"check", kUr5, "--functions", "rnea,aba", "--states", "10", "--cxxflags", "-O1 -std=c++17"});
  EXPECT_EQ(outcome.status, 0) << outcome.err << outcome.out;
  EXPECT_FALSE(contains(outcome.out, "WRONG")) << outcome.out;
}

TEST(CliStatus, JsonStandsAloneOnStandardOutput) {
  const std::string all = ARBOC_SOURCE_DIR "/models/humanoid/humanoid.urdf";
  const Outcome outcome =
      run_arboc({"inspect", all, "--json", "--base", "floating", "--ops", "rnea"});
  EXPECT_EQ(outcome.status, 0);
  const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << outcome.out;
  EXPECT_EQ(json["nq"], json["nv"].get<int>() + 1);
  EXPECT_GT(json["mass"], 70);
  EXPECT_GT(json["ops"]["rnea"]["fma"], 0);

  const TempDir folder;
  write_text(folder / "leaf.urdf", with_massless_leaf());
  const Outcome warned = run_arboc({"inspect", folder / "leaf.urdf", "--json"});
  EXPECT_EQ(warned.status, 0);
  EXPECT_TRUE(contains(warned.err, "warning: link 'tip'")) << warned.err;
  const auto warnings = nlohmann::json::parse(warned.out, nullptr, false);
  ASSERT_TRUE(warnings.is_object()) << warned.out;
  EXPECT_FALSE(warnings["warnings"].empty());

  const Outcome bench = run_arboc(
      {"bench", kUr5, "--functions", "gravity", "--json", "--cxxflags", "-std=c++17 -O1"});
  EXPECT_EQ(bench.status, 0) << bench.err;
  const auto rows = nlohmann::json::parse(bench.out, nullptr, false);
  ASSERT_EQ(rows.size(), 1u) << bench.out;
  EXPECT_EQ(rows[0]["function"], "gravity");
  EXPECT_NEAR(rows[0]["ratio"].get<double>(),
              rows[0]["generic_ns"].get<double>() / rows[0]["generated_ns"].get<double>(), 1e-9);
}

TEST(CliStatus, BenchInLanesIsJson) {
  const Outcome bench = run_arboc({"bench", kUr5, "--functions", "gravity", "--json", "--lanes",
                                   "2,8f", "--cxxflags", "-std=c++17 -O1"});
  EXPECT_EQ(bench.status, 0) << bench.err;
  const auto rows = nlohmann::json::parse(bench.out, nullptr, false);
  ASSERT_EQ(rows.size(), 1u) << bench.out;
  const auto& lanes = rows[0]["lanes"];
  ASSERT_EQ(lanes.size(), 2u) << bench.out;
  EXPECT_EQ(lanes[0]["lanes"], 2);
  EXPECT_EQ(lanes[1]["scalar"], "float");
  EXPECT_NEAR(lanes[0]["ratio_to_scalar"].get<double>(),
              rows[0]["scalar_ns"].get<double>() / lanes[0]["ns"].get<double>(), 1e-9);
  EXPECT_LE(lanes[0]["difference"].get<double>(), 1e-13);
}

TEST(CliStatus, EachStagePrints) {
  for (const auto& [stage, start] :
       std::vector<std::pair<std::string, std::string>>{{"model", "model ur5: "},
                                                        {"tree", "# rnea\ntree ur5: 6 bodies"},
                                                        {"graph", "region rnea\nin q 6\n"},
                                                        {"program", "program rnea: "}}) {
    const Outcome outcome = run_arboc({"compile", kUr5, "--functions", "rnea", "--print", stage});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with(start)) << outcome.out.substr(0, 200);
  }
}

}  // namespace
}  // namespace arboc::test

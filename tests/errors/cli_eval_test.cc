// `arboc eval`: what it accepts as input, and what it writes.
#include <gtest/gtest.h>

#include "support/run_program.h"

namespace arboc::test {
namespace {

const std::string kPendulum = ARBOC_SOURCE_DIR "/models/double_pendulum/double_pendulum.urdf";
const std::string kQuadruped = ARBOC_SOURCE_DIR "/models/quadruped/quadruped.urdf";

class CliEval : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    write_text(folder_ / name, text);
    return folder_ / name;
  }
  static Outcome eval(const std::string& function, std::vector<std::string> rest,
                      const std::string& model = kPendulum) {
    rest.insert(rest.begin(), {"eval", model, "--engine", "generic", "--function", function});
    return run_arboc(rest);
  }

  TempDir folder_;
};

TEST_F(CliEval, WrongTablesExitWith2AndSayWhere) {
  const auto expect = [&](const std::string& text, const std::string& message) {
    const std::string path = file("q.csv", text);
    const Outcome outcome = eval("gravity", {"--q", path});
    EXPECT_EQ(outcome.status, 2) << text;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, path + message + "\n");
  };
  expect("", ": error: no states in the file");
  expect("\n \n", ": error: no states in the file");
  expect("1,2,3\n", ":1: error: 3 numbers, but q has 2 (one state a line)");
  expect("1,2\n\n1\n", ":3: error: 1 numbers, but q has 2 (one state a line)");
  expect("1,2,\n", ":1: error: '' is not a finite number");
  expect("1;2\n", ":1: error: '1;2' is not a finite number");
  expect("1,two\n", ":1: error: 'two' is not a finite number");
  expect("q1,q2\n1,2\n", ":1: error: 'q1' is not a finite number");
  expect("1,nan\n", ":1: error: 'nan' is not a finite number");
  expect("1,1e999\n", ":1: error: '1e999' is not a finite number");
  expect("1,0x10\n", ":1: error: '0x10' is not a finite number");
  expect("1,\x1b[31m\n", ":1: error: '\\x1b[31m' is not a finite number");
}

TEST_F(CliEval, EndlessTablesEnd) {
  const Outcome outcome = run_arboc({"eval", ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf", "--function",
                                     "gravity", "--engine", "generic", "--q", "/dev/zero"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err,
            "/dev/zero: error: is too large: the limit is 1024 MiB, and 64 MiB a line\n");
}

TEST_F(CliEval, MissingTablesExitWith2) {
  const std::string missing = folder_ / "missing.csv";
  const Outcome outcome = eval("gravity", {"--q", missing});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, missing + ": error: cannot open: No such file or directory\n");
  const Outcome directory = eval("gravity", {"--q", folder_.path()});
  EXPECT_EQ(directory.status, 2);
  EXPECT_EQ(directory.err, folder_.path() + ": error: cannot read: Is a directory\n");
}

TEST_F(CliEval, TablesMustHaveTheSameLength) {
  const std::string q = file("q.csv", "1,2\n3,4\n"), v = file("v.csv", "1,2\n3,4\n5,6\n");
  const Outcome outcome = eval("nle", {"--q", q, "--v", v});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err, v + ": error: 3 states, but 2 in the files before it\n");
  // One line serves all states.
  const std::string one = file("one.csv", "1,2\n");
  EXPECT_EQ(numbers(eval("nle", {"--q", q, "--v", one}).out).size(), 2u);
}

TEST_F(CliEval, ReadsTablesAsPeopleWriteThem) {
  const std::string plain = file("plain.csv", "0.3,-0.8\n1,2\n");
  const std::string fancy = file("fancy.csv", " 3e-1 ,\t-0.80\r\n\r\n+1.0,2.");
  const Outcome expected = eval("gravity", {"--q", plain});
  EXPECT_EQ(expected.status, 0);
  EXPECT_EQ(expected.err, "");
  EXPECT_EQ(numbers(expected.out).size(), 2u);
  EXPECT_EQ(eval("gravity", {"--q", fancy}).out, expected.out);
}

TEST_F(CliEval, InputsThatDoNotMatterMayBeLeftOut) {
  const std::string q = file("q.csv", "0.3,-0.8\n"), v = file("v.csv", "1,2\n");
  EXPECT_EQ(eval("nle", {"--v", v}).status, 1);
  EXPECT_EQ(eval("nle", {"--q", q}).status, 1);
  // A vertical axis: gravity does no work on it, whatever its angle.
  const std::string spinner = file("spinner.urdf", R"(<robot name="spinner"><link name="a"/>
<link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="2"/>
</inertial></link><joint name="j" type="continuous"><parent link="a"/><child link="b"/>
<axis xyz="0 0 1"/></joint></robot>)");
  const Outcome outcome = eval("gravity", {}, spinner);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "0\n");
  EXPECT_EQ(eval("crba", {}, spinner).out, "2\n");
}

TEST_F(CliEval, WritesNumbersThatReadBackExactly) {
  const std::string q = file("q.csv", "0.3,-0.8\n");
  // models/double_pendulum/ORIGIN.md
  const auto g = numbers(eval("gravity", {"--q", q}).out);
  ASSERT_EQ(g.size(), 1u);
  ASSERT_EQ(g[0].size(), 2u);
  EXPECT_NEAR(g[0][0], 2.773389192761204, 1e-14);
  EXPECT_NEAR(g[0][1], -0.7054746800560847, 1e-15);
  const Outcome M = eval("crba", {"--q", q, "--output", "M"});
  EXPECT_EQ(csv_text(numbers(M.out)), M.out);
  EXPECT_EQ(numbers(M.out).at(0).size(), 4u);
}

TEST_F(CliEval, WarnsOfQuaternionsThatAreNoUnits) {
  std::string good = "0,0,0,0,0,0,1", bad = "0,0,0,0,0,0,2";
  for (int k = 0; k < 12; ++k) {
    good += ",0";
    bad += ",0";
  }
  const std::string q = file("q.csv", good + "\n" + bad + "\n");
  const Outcome outcome = eval("gravity", {"--q", q, "--base", "floating"}, kQuadruped);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err,
            "warning: joint 'root_joint': state 2: quaternion of length 2 (x y z w of length 1 "
            "expected)\n");
  EXPECT_EQ(numbers(outcome.out).size(), 2u);
}

}  // namespace
}  // namespace arboc::test

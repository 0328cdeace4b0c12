// One wrong option a message, and the whole first line of what is said about it.
#include <gtest/gtest.h>

#include <sstream>

#include "support/run_program.h"

namespace arboc::test {
namespace {

using Arguments = std::vector<std::string>;

const std::string kModel = ARBOC_SOURCE_DIR "/models/double_pendulum/double_pendulum.urdf";

const std::string kUr5 = ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf";

struct Case {
  Arguments options;
  const char* said;  ///< after "arboc: error: ", up to the end of the line
};

void expect_usage_errors(Arguments before, const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.said);
    Arguments arguments = before;
    arguments.insert(arguments.end(), c.options.begin(), c.options.end());
    const Outcome outcome = run_arboc(arguments);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, std::string("arboc: error: ") + c.said + "\n(arboc " + before[0] +
                               " --help explains the usage)\n");
  }
}

TEST(CliOptions, Derivatives) {
  expect_usage_errors(
      {"compile", kModel, "-o", "/dev/null/out"},
      {{{"--jacobian", "rne.tau"},
        "--jacobian rne.tau: there is no function 'rne' (did you mean 'rnea'?)"},
       {{"--jacobian", "rnea.ta:q"},
        "--jacobian rnea.ta:q: rnea has no output 'ta' (did you mean 'tau'?)"},
       {{"--jacobian", "rnea.torque"},
        "--jacobian rnea.torque: rnea has no output 'torque' (known are 'tau')"},
       {{"--vjp", "rnea.tau:qq"},
        "--vjp rnea.tau:qq: rnea has no input 'qq' (known are 'q', 'v', 'a')"},
       {{"--vjp", "rnea.tau:lambda"},
        "--vjp rnea.tau:lambda: rnea has no input 'lambda' (known are 'q', 'v', 'a')"},
       {{"--jacobian", "rnea.tau:f_ext"},
        "--jacobian rnea.tau:f_ext: rnea has no input 'f_ext' (known are 'q', 'v', 'a')"},
       {{"--jacobian", "rnea.tau:q,v,q"}, "--jacobian rnea.tau:q,v,q: input 'q' is given twice"},
       {{"--jacobian", "rnea"},
        "--jacobian: 'rnea' is not of the form FUNCTION.OUTPUT[:INPUT,...], such as rnea.tau:q,v"},
       {{"--hessian", "rnea.tau:"},
        "--hessian: 'rnea.tau:' is not of the form FUNCTION.OUTPUT[:INPUT,...], such as "
        "rnea.tau:q,v"},
       {{"--jacobian", "rnea.tau^2:q"},
        "--jacobian: 'rnea.tau^2:q': a sum of squares has a --gradient and a --hessian"},
       {{"--gradient", "rnea.tau:q"},
        "--gradient rnea.tau:q: tau has 2 entries: ask for its --vjp, or for tau^2, the sum of its "
        "squares"},
       {{"--hessian", "rnea_derivatives.M:q"},
        "--hessian rnea_derivatives.M:q: rnea_derivatives is a derivative itself; ask for one of "
        "rnea"},
       {{"--hessian", "rnea_hessian.H_qq"},
        "--hessian rnea_hessian.H_qq: rnea_hessian is a derivative itself; ask for one of rnea"}});
}

TEST(CliOptions, Functions) {
  expect_usage_errors(
      {"compile", kModel, "-o", "/dev/null/out"},
      {{{"--functions", "rnae"}, "--functions: there is no function 'rnae' (did you mean 'rnea'?)"},
       {{"--functions", ""}, "--functions: the list is empty"},
       {{"--functions", ","},
        "--functions: there is no function '' (known are 'fk', 'rnea', 'gravity', 'statics', "
        "'nle', 'crba', "
        "'minv', 'aba', 'rnea_derivatives', 'aba_derivatives', 'rnea_hessian', 'frame_velocity', "
        "'frame_acceleration', 'frame_jacobian', 'frame_jacobian_dot', "
        "'frame_velocity_derivatives', 'frame_acceleration_derivatives', 'joint_jacobians', "
        "'transforms', 'com', "
        "'com_jacobian', 'centroidal', 'energy', 'regressor', 'integrate', 'difference', "
        "'integrate_derivatives', 'difference_derivatives')"},
       {{"--frames", "lower_rot"},
        "--frames: there is no link 'lower_rot' (did you mean 'lower_rod'?)"},
       {{"--frames", "tool"},
        "--frames: there is no link 'tool' (known are 'base', 'upper_rod', 'lower_rod')"},
       {{"--frames", ""}, "--frames: the list is empty"},
       {{"--axes", "body"}, "--axes: expected local or world or aligned, not 'body'"},
       {{"--transform-order", "4"}, "--transform-order: Value 4 not in range 0 to 3"},
       {{"--external-forces", "lower_rod,lower_rod"},
        "--external-forces: link 'lower_rod' is given twice"},
       {{"--external-forces", "tool"},
        "--external-forces: there is no link 'tool' (known are 'base', 'upper_rod', 'lower_rod')"},
       {{"--joint-forces", "dampign"},
        "--joint-forces: there is no force 'dampign' (did you mean 'damping'?)"},
       {{"--joint-forces", "wind"},
        "--joint-forces: there is no force 'wind' (known are 'damping', 'friction', 'stiffness', "
        "'rotor')"},
       {{"--joint-forces", ""}, "--joint-forces: the list is empty"},
       {{"--friction-velocity", "0"}, "--friction-velocity: expected a positive number, not 0"}});
  expect_usage_errors({"inspect", kModel}, {{{"--ops", "rnae"},
                                             "--ops: there is no function 'rnae' (did you mean "
                                             "'rnea'?)"}});
}

TEST(CliOptions, Parameters) {
  expect_usage_errors(
      {"compile", kModel, "-o", "/dev/null/out"},
      {{{"--parameters", "mass"},
        "--parameters: there is no group 'mass' (did you mean 'masses'?)"},
       {{"--parameters", "colour"},
        "--parameters: there is no group 'colour' (known are 'gravity', 'masses', 'centres', "
        "'inertias', 'lengths', 'stiffness', 'neutral')"},
       {{"--parameters", "masses:upper"},
        "--parameters: there is no link 'upper' (known are 'base', 'upper_rod', 'lower_rod')"},
       {{"--parameters", "lengths:elbo"},
        "--parameters: there is no joint 'elbo' (did you mean 'elbow'?)"},
       {{"--parameters", "gravity:base"},
        "--parameters: gravity is one for all links: write gravity"},
       {{"--parameters", ""}, "--parameters: the list is empty"}});
  expect_usage_errors({"compile", kUr5, "-o", "/dev/null/out"},
                      {{{"--parameters", "masses:flange"},
                        "--parameters: link 'flange' has no masses: it has no <inertial>"}});
  expect_usage_errors({"compile", kModel, "-o", "/dev/null/out", "--base", "floating"},
                      {{{"--parameters", "lengths:root_joint"},
                        "--parameters: joint 'root_joint' has no lengths: it holds the base"}});
}

TEST(CliOptions, InputsOfEval) {
  const TempDir folder;
  write_text(folder / "two", "0.1,0.2\n");
  const std::string two = folder / "two";
  const Arguments eval = {"eval", kModel, "--engine", "generic", "--q", two};
  expect_usage_errors(
      eval,
      {{{},
        "eval evaluates one thing: --function F, or one derivative of an output; none is given"},
       {{"--function", "rnea", "--jacobian", "rnea.tau"},
        "eval evaluates one thing: --function F, or one derivative of an output; several are "
        "given"},
       {{"--function", "rnea"}, "--v (an input of rnea) is required"},
       {{"--function", "nle", "--v", two, "--external-forces", "lower_rod"},
        "--f-ext (an input of nle) is required"},
       {{"--vjp", "gravity.g"}, "--lambda (an input of gravity_g_vjp) is required"},
       {{"--function", "gravity", "--input", "masses=" + two},
        "--input: gravity has no input 'masses' (known are 'q')"},
       {{"--function", "gravity", "--input", "mases=" + two, "--parameters", "masses"},
        "--input: gravity has no input 'mases' (did you mean 'masses'?)"},
       {{"--function", "gravity", "--lambda", two},
        "--lambda: gravity has no input 'lambda' (known are 'q')"},
       {{"--function", "nle", "--v", two, "--f-ext", two},
        "--f-ext: nle has no input f_ext (of rnea, nle, aba and their derivatives it is one where "
        "--external-forces names links)"},
       {{"--function", "gravity", "--output", "G"},
        "--output: gravity has no output 'G' (did you mean 'g'?)"}});
}

TEST(CliOptions, TablesOfOtherWidthNameTheInput) {
  const TempDir folder;
  write_text(folder / "two", "0.1,0.2\n");
  write_text(folder / "three", "1,2,3\n");
  const Outcome outcome = run_arboc({"eval", kModel, "--engine", "generic", "--vjp", "gravity.g",
                                     "--q", folder / "two", "--lambda", folder / "three"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err,
            folder / "three" + ":1: error: 3 numbers, but lambda has 2 (one state a line)\n");
}

TEST(CliOptions, FilesOfCommonInputsAreLeftUnread) {
  const TempDir folder;
  write_text(folder / "two", "0.1,0.2\n");
  const Outcome outcome = run_arboc({"eval", kModel, "--engine", "generic", "--function", "gravity",
                                     "--q", folder / "two", "--tau", "missing"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "note: tau is no input of gravity; missing is not read\n");
}

TEST(CliOptions, NoMassNoCentreOfMass) {
  const TempDir folder;
  write_text(folder / "ghost.urdf",
             R"(<robot name="ghost"><link name="a"/><link name="b"/><joint name="j"
type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>)");
  for (const std::string function : {"com", "com_jacobian", "centroidal"}) {
    const Outcome outcome = run_arboc(
        {"compile", folder / "ghost.urdf", "-o", folder / "out", "--functions", function});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.err.substr(outcome.err.find('\n') + 1),
              "ghost.urdf: error: nothing that moves has mass, so " + function +
                  " has no value (give links mass, or leave " + function + " out)\n");
  }
  const Outcome rest = run_arboc({"compile", folder / "ghost.urdf", "-o", folder / "out",
                                  "--functions", "rnea,energy,frame_jacobian"});
  EXPECT_EQ(rest.status, 0) << rest.err;
}

TEST(CliOptions, JointForcesThatNoJointHasAreSaid) {
  const TempDir folder;
  const Outcome outcome = run_arboc(
      {"compile", kUr5, "-o", folder / "out", "--functions", "rnea", "--joint-forces", "rotor"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err,
            "ur5.urdf: warning: --joint-forces rotor: no joint of the model has any\n");
}

TEST(CliOptions, SimplificationsCanBeLeftOut) {
  const auto total = [](const Arguments& more) {
    Arguments command{"inspect", kUr5, "--ops", "rnea"};
    command.insert(command.end(), more.begin(), more.end());
    const std::string out = run_arboc(command).out;
    std::istringstream row(out.substr(out.rfind("\nrnea ") + 6));
    int operations = 0;
    row >> operations;
    return operations;
  };
  EXPECT_LT(total({}), total({"--without", "regroup"}));
  EXPECT_LT(total({"--without", "regroup"}), total({"--without", "regroup,fuse,frames"}));
  const Outcome wrong = run_arboc({"inspect", kUr5, "--ops", "rnea", "--without", "fusion"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_NE(wrong.err.find("--without: there is no simplification 'fusion'"), std::string::npos)
      << wrong.err;
}

TEST(CliOptions, BenchSaysWhatCompilingCosts) {
  const Outcome outcome = run_arboc({"bench", kModel, "--compile", "--functions", "rnea,crba"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  std::istringstream table(outcome.out);
  std::string line, function;
  std::getline(table, line);
  int rows = 0;
  for (double operations, seconds, each, memory, size;
       table >> function >> operations >> seconds >> each >> memory >> size; ++rows) {
    EXPECT_GT(operations, 0);
    EXPECT_GT(seconds, 0);
    EXPECT_GT(memory, 1);
    EXPECT_GT(size, 0.1);
  }
  EXPECT_EQ(rows, 2);
  EXPECT_EQ(run_arboc({"bench", kModel, "--compile", "--cxx", "no-such-compiler"}).status, 4);
}

TEST(CliOptions, InspectShowsParameters) {
  const Outcome outcome = run_arboc({"inspect", kModel, "--parameters", "masses:lower_rod"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("parameter masses (kg): one a link\n   0  lower_rod.mass "),
            std::string::npos)
      << outcome.out;
}

}  // namespace
}  // namespace arboc::test

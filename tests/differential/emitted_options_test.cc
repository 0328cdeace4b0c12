// Emitted folders with every option of the functions: built by their own CMakeLists.txt, tested by
// their own selftest, and used through Eigen against `arboc eval`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "functions/catalogue.h"
#include "support/random.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

using Command = std::vector<std::string>;

std::string path_of(const std::string& model) {
  return ARBOC_SOURCE_DIR "/models/" + model + "/" + model + ".urdf";
}

Command joined(Command a, const Command& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void expect_success(const Command& command) {
  const Outcome outcome = run_program(command);
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err.substr(0, 4000);
}

void emit(const TempDir& folder, const std::string& model, const Command& options) {
  const Outcome outcome =
      run_arboc(joined({"compile", path_of(model), "-o", folder.path()}, options));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
}

/// Code that runs once is compiled without optimisation.
void build(const std::string& source, const std::string& build) {
  ASSERT_NO_FATAL_FAILURE(
      expect_success({ARBOC_CMAKE, "-S", source, "-B", build, "-G", ARBOC_GENERATOR,
                      "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_CXX_FLAGS=-O0"}));
  expect_success({ARBOC_CMAKE, "--build", build, "--parallel", "2"});
}

/// Every function's line says ok.
void expect_selftest_names(const std::string& program, const std::vector<std::string>& functions) {
  const Outcome outcome = run_program({program});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  for (const std::string& function : functions)
    EXPECT_NE(("\n" + outcome.out).find("\n" + function), std::string::npos) << outcome.out;
}

TEST(EmittedOptions, AllFunctionsPassTheirSelftest) {
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(
      emit(folder, "all_joints",
           {"--base", "floating", "--functions", "all", "--axes", "world", "--external-forces",
            "tip,buoy", "--joint-forces", "damping,friction,stiffness,rotor", "--parameters",
            "gravity", "--hessian", "energy.V:q,gravity", "--jacobian", "energy.T"}));
  ASSERT_NO_FATAL_FAILURE(build(folder / "all_joints", folder / "build"));
  std::vector<std::string> functions = function_names();
  functions.insert(functions.end(), {"energy_V_hessian_q_gravity", "energy_T_jacobian"});
  expect_selftest_names(folder / "build/all_joints_selftest", functions);
}

/// What is too much for a selftest is recorded as projections; they notice any wrong entry.
class SelftestOfProjections : public testing::Test {
 protected:
  void SetUp() override {
    emit(folder_, "quadruped",
         {"--base", "floating", "--functions", "frame_jacobian", "--jacobian", "rnea.tau:q,f_ext",
          "--hessian", "rnea.tau:q,v", "--external-forces", "trunk,left_front_foot"});
    text_ = read_text(test_);
  }

  /// Compiles all functions with the text of a selftest; its exit status.
  int run(const std::string& text) const {
    write_text(test_, text);
    Command command{"c++", "-std=c++17", "-O0", "-I", folder_ / "quadruped",
                    "-o",  selftest_,    test_};
    for (const char* f : {"frame_jacobian", "rnea_tau_jacobian_q_f_ext", "rnea_tau_hessian_q_v"})
      command.push_back(folder_ / "quadruped/quadruped_" + f + "_double.cpp");
    EXPECT_EQ(run_program(command).status, 0);
    return run_program({selftest_}).status;
  }

  /// Output k of a function is compared once more for each entry of it, of which that one is off by
  /// a millionth of the largest; what is not noticed is a failure.
  static void plant(std::string& text, const std::string& name, int k, double tolerance) {
    const std::string head = fmt::format("    worst({}_error, ", name);
    const size_t at = text.find(head), end = text.find(");\n", at);
    ASSERT_NE(end, std::string::npos) << text;
    const std::string error = text.substr(at + head.size(), end - at - head.size());
    EXPECT_EQ(error.find("error_of_projections(dense"), 0u) << error;
    text.insert(at,
                fmt::format("    double largest{0} = 0;\n"
                            "    for (const double x : out{0}) worst(largest{0}, std::fabs(x));\n"
                            "    if (largest{0} == 0) ++failures;\n"
                            "    for (double& entry : out{0}) {{\n"
                            "      const double right = entry;\n"
                            "      entry += 1e-6 * largest{0};\n"
                            "      quadruped::raw::scatter_{1}(out{0}.data(), dense{0}.data());\n"
                            "      if (!({2} > {3})) ++failures;\n"
                            "      entry = right;\n"
                            "    }}\n"
                            "    quadruped::raw::scatter_{1}(out{0}.data(), dense{0}.data());\n",
                            k, name, error, tolerance));
  }

  const TempDir folder_;
  const std::string test_ = folder_ / "quadruped/quadruped_selftest.cpp";
  const std::string selftest_ = folder_ / "selftest";
  std::string text_;
};

TEST_F(SelftestOfProjections, IsSmallAndNoticesEveryEntry) {
  EXPECT_LT(text_.size(), 20000u);
  EXPECT_NE(text_.find("rnea_tau_hessian_q_v_H_qq_error, 1e-09"), std::string::npos);
  EXPECT_NE(text_.find("rnea_tau_jacobian_q_f_ext_dtau_dq_error, 1e-11"), std::string::npos);
  std::string planted = text_;
  plant(planted, "frame_jacobian_J", 0, 1e-11);
  plant(planted, "rnea_tau_jacobian_q_f_ext_dtau_dq", 0, 1e-11);
  plant(planted, "rnea_tau_jacobian_q_f_ext_dtau_df_ext", 1, 1e-11);
  plant(planted, "rnea_tau_hessian_q_v_H_qq", 0, 1e-9);
  plant(planted, "rnea_tau_hessian_q_v_H_qv", 1, 1e-9);
  plant(planted, "rnea_tau_hessian_q_v_H_vv", 2, 1e-9);
  EXPECT_EQ(run(planted), 0);
}

/// One entry of the functions' text.
TEST_F(SelftestOfProjections, FailsWhereOneStatementIsWrong) {
  for (const char* wrong :
       {"rnea_tau_jacobian_q_f_ext.hpp dtau_dq[20] = ", "rnea_tau_hessian_q_v.hpp H_qq[30] = "}) {
    const std::string all = wrong;
    const size_t space = all.find(' ');
    const std::string file = folder_ / "quadruped/quadruped_" + all.substr(0, space);
    const std::string right = read_text(file), entry = all.substr(space);
    const size_t at = right.find(entry);
    ASSERT_NE(at, std::string::npos) << right;
    write_text(file, std::string(right).insert(at + entry.size(), "T(1e-4) + "));
    EXPECT_EQ(run(text_), 1) << wrong;
    write_text(file, right);
  }
}

class EmittedOptionsEigen : public testing::Test {
 protected:
  const Command kShared = {"--base",
                           "floating",
                           "--frames",
                           "trunk,left_front_foot",
                           "--external-forces",
                           "left_front_foot,right_hind_foot",
                           "--parameters",
                           "gravity,masses"};

  void build_consumer() const {
    ASSERT_NO_FATAL_FAILURE(
        emit(folder_, "quadruped",
             joined(kShared,
                    {"--functions", "rnea,gravity,fk,frame_jacobian,aba_derivatives,energy,crba",
                     "--jacobian", "rnea.tau:f_ext", "--vjp", "rnea.tau:v,masses"})));
    write_text(folder_ / "CMakeLists.txt",
               "cmake_minimum_required(VERSION 3.16)\nproject(user CXX)\n"
               "set(QUADRUPED_SELFTEST ON)\nadd_subdirectory(quadruped)\n"
               "add_executable(user " ARBOC_SOURCE_DIR
               "/tests/differential/emitted_options.cpp)\n"
               "target_link_libraries(user PRIVATE quadruped::quadruped)\n");
    build(folder_.path(), folder_ / "build");
  }

  /// Draws the inputs and writes each to a file of its name.
  std::string draw_inputs() const {
    Random random(7);
    const auto draw = [&](size_t n, double low, double high) {
      std::vector<double> x;
      for (size_t k = 0; k < n; ++k) x.push_back(random.uniform(low, high));
      return x;
    };
    std::vector<double> q = draw(19, -1, 1);
    double norm = 0;
    for (size_t k = 3; k < 7; ++k) norm += q[k] * q[k];
    for (size_t k = 3; k < 7; ++k) q[k] /= std::sqrt(norm);
    std::string all;
    const auto give = [&](const std::string& name, const std::vector<double>& x) {
      write_text(folder_ / name, csv_text({x}));
      all += csv_text({x});
    };
    give("q", q);
    for (const char* name : {"v", "a", "tau"}) give(name, draw(18, -2, 2));
    give("f_ext", draw(12, -5, 5));
    give("gravity", draw(3, -9, 9));
    give("masses", draw(masses(), 0.5, 2));
    give("lambda", draw(18, -1, 1));
    for (char& c : all) c = c == ',' ? ' ' : c;
    return all;
  }

  /// Links with mass, as the emitted header counts them.
  size_t masses() const {
    const std::string header = read_text(folder_ / "quadruped/quadruped_raw.hpp");
    const std::string count = "namespace masses {\ninline constexpr int count = ";
    return std::stoul(header.substr(header.find(count) + count.size()));
  }

  std::vector<double> eval(const std::string& what) const {
    const size_t dot = what.find('.');
    const std::string function = what.substr(0, dot);
    Command request{"--function", function};
    if (function == "rnea_tau_jacobian_f_ext") request = {"--jacobian", "rnea.tau:f_ext"};
    if (function == "rnea_tau_vjp_v_masses")
      request = {"--vjp", "rnea.tau:v,masses", "--lambda", folder_ / "lambda"};
    if (function == "rnea" || function.starts_with("rnea_") || function.starts_with("aba"))
      request = joined(request, {"--f-ext", folder_ / "f_ext"});
    Command command = joined({"eval", path_of("quadruped"), "--engine", "generic"}, kShared);
    for (const char* input : {"q", "v", "a", "tau"})
      command = joined(command, {std::string("--") + input, folder_ / input});
    for (const char* input : {"gravity", "masses"})
      command = joined(command, {"--input", std::string(input) + "=" + (folder_ / input)});
    command = joined(joined(command, request), {"--output", what.substr(dot + 1)});
    const Outcome outcome = run_arboc(command);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const auto rows = numbers(outcome.out);
    return rows.empty() ? std::vector<double>{} : rows[0];
  }

  TempDir folder_;
};

TEST_F(EmittedOptionsEigen, SaysWhatEvalSays) {
  ASSERT_NO_FATAL_FAILURE(build_consumer());
  expect_selftest_names(folder_ / "build/quadruped/quadruped_selftest",
                        {"rnea", "rnea_tau_jacobian_f_ext", "rnea_tau_vjp_v_masses.vjp_masses"});
  RunOptions how;
  how.input = folder_ / "inputs";
  write_text(how.input, draw_inputs());
  const Outcome consumer = run_program({folder_ / "build/user"}, how);
  ASSERT_EQ(consumer.status, 0) << consumer.out << consumer.err;
  std::istringstream lines(consumer.out);
  int outputs = 0;
  for (std::string line; std::getline(lines, line); ++outputs) {
    const std::string what = line.substr(0, line.find(':'));
    const std::vector<double> got = numbers(line.substr(line.find(':') + 1)).at(0);
    const std::vector<double> expected = eval(what);
    ASSERT_EQ(got.size(), expected.size()) << what;
    double largest = 0;
    for (const double x : expected) largest = std::max(largest, std::fabs(x));
    // Two orders of the same operations, amplified by the condition of the mass matrix.
    const double tolerance = (what.starts_with("aba") ? 1e-9 : 1e-12) * largest;
    for (size_t k = 0; k < got.size(); ++k) EXPECT_NEAR(got[k], expected[k], tolerance) << what;
  }
  EXPECT_EQ(outputs, 11);
}

}  // namespace
}  // namespace arboc::test

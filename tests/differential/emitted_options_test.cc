// Emitted folders with every option of the functions: built by their own CMakeLists.txt, tested by
// their own selftest, and used through Eigen against `arboc eval`.
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

/// What is too much for a selftest is recorded as weighted sums, which notice a wrong entry.
TEST(EmittedOptions, SelftestsOfLargeOutputsAreSmallAndCanFail) {
  const TempDir folder;
  ASSERT_NO_FATAL_FAILURE(
      emit(folder, "quadruped", {"--base", "floating", "--functions", "frame_jacobian"}));
  const std::string test = folder / "quadruped/quadruped_selftest.cpp";
  const std::string text = read_text(test);
  EXPECT_LT(text.size(), 10000u);
  EXPECT_NE(text.find("error_of_sums(dense0, frame_jacobian_J[s])"), std::string::npos);
  const auto run = [&] {
    EXPECT_EQ(run_program({"c++", "-std=c++17", "-O0", "-I", folder / "quadruped", test,
                           folder / "quadruped/quadruped_frame_jacobian_double.cpp", "-o",
                           folder / "selftest"})
                  .status,
              0);
    return run_program({folder / "selftest"}).status;
  };
  EXPECT_EQ(run(), 0);
  // One entry, off by a part in a thousand of the largest.
  std::string wrong = text;
  const std::string after = "    worst(frame_jacobian_J_error";
  wrong.insert(wrong.find(after), "    dense0[1000] += 1e-3;\n");
  write_text(test, wrong);
  EXPECT_EQ(run(), 1);
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

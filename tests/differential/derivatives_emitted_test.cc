// Emitted rnea_derivatives, compiled: its pointers and its Eigen interface against the generic
// engine, also where outputs are not wanted or have no entry at all.
#include <gtest/gtest.h>

#include "cli/build.h"
#include "emit/emit.h"
#include "frontend/urdf.h"
#include "state_source.h"

namespace arboc::test {
namespace {

using Eigen::VectorXd;

constexpr double kRounding = 1e-12;  // relative to the largest entry

cli::Common compiler() {
  cli::Common common;
  common.cxxflags = "-std=c++17 -O1 -Wall -Wextra -Wpedantic -Werror";
  return common;
}

Compilation compile_robot(const std::string& name, Base base, const CompileOptions& options) {
  CompileOptions with_base = options;
  with_base.model.base = base;
  Diagnostics diagnostics;
  const std::string path = std::string(ARBOC_SOURCE_DIR) + "/models/" + name + "/" + name + ".urdf";
  return compile(read_urdf(path, diagnostics), with_base, diagnostics);
}

CompileOptions derivatives_only() {
  CompileOptions options;
  options.requests = {{"rnea_derivatives"}};
  return options;
}

Values next_state(StateSource& source, const Model& model) {
  const arboc::State s = source.next(model);
  const auto list = [](const VectorXd& x) { return std::vector<double>(x.begin(), x.end()); };
  return {{"q", list(s.q)}, {"v", list(s.v)}, {"a", list(s.a)}};
}

Values generic_results(const Compilation& compilation, const Values& in) {
  const CompiledFunction& f = compilation.functions.front();
  return evaluate_generic(f.request, compilation.setup, f.lowering, in);
}

void expect_near(const std::vector<double>& got, const std::vector<double>& expected,
                 const std::string& what) {
  ASSERT_EQ(got.size(), expected.size()) << what;
  double largest = 0;
  for (const double x : expected) largest = std::max(largest, std::fabs(x));
  for (size_t k = 0; k < got.size(); ++k)
    ASSERT_NEAR(got[k], expected[k], kRounding * largest) << what << ", entry " << k;
}

void expect_generic_results(const std::string& name, Base base) {
  const CompileOptions options = derivatives_only();
  const Compilation compilation = compile_robot(name, base, options);
  const cli::GeneratedCode code(compiler(), target(compilation, options));
  StateSource source(5);
  for (int s = 0; s < 10; ++s) {
    const Values in = next_state(source, compilation.setup.model);
    const Values got = code.call("rnea_derivatives", in);
    for (const auto& [output, values] : generic_results(compilation, in))
      expect_near(got.at(output), values, output);
  }
}

TEST(EmittedDerivatives, OfAnArmAreTheGenericOnes) { expect_generic_results("ur5", Base::kFixed); }

TEST(EmittedDerivatives, OfAQuadrupedAreTheGenericOnes) {
  expect_generic_results("quadruped", Base::kFloating);
}

constexpr const char* kEigenCalls = R"(#include "ur5/ur5.hpp"
extern "C" void call(const double* q, const double* v, const double* a, double* dq, double* M) {
  const Eigen::Map<const ur5::Config> q_(q);
  const Eigen::Map<const ur5::Tangent> v_(v), a_(a);
  ur5::Matrix some, inertia;
  ur5::RneaDerivatives out;
  out.M = &inertia;
  out.dtau_dq = &some;
  ur5::rnea_derivatives(q_, v_, a_, out);
  Eigen::Map<ur5::Matrix>(dq, ur5::nv, ur5::nv) = some.transpose();
  Eigen::Map<ur5::Matrix>(M, ur5::nv, ur5::nv) = inertia;
  ur5::rnea_derivatives(q_, v_, a_, {});
}
)";

TEST(EmittedDerivatives, FillInTheMatricesThatAreWanted) {
  const CompileOptions options = derivatives_only();
  const Compilation compilation = compile_robot("ur5", Base::kFixed, options);
  const cli::TemporaryFolder folder;
  Files files;
  for (const auto& [path, bytes] : emit(target(compilation, options)))
    files["ur5/" + path] = bytes;
  files["calls.cpp"] = kEigenCalls;
  cli::Common common = compiler();
  common.cxxflags = "-std=c++17 -O1 -isystem " ARBOC_EIGEN_INCLUDE;
  const cli::Library library(cli::build_library(
      common, folder.path(), files, {"ur5/ur5_rnea_derivatives_double.cpp", "calls.cpp"}));
  using Call = void (*)(const double*, const double*, const double*, double*, double*);
  const auto call = reinterpret_cast<Call>(library.symbol("call"));
  StateSource source(5);
  const Values in = next_state(source, compilation.setup.model);
  std::vector<double> dq(36), M(36);
  call(in.at("q").data(), in.at("v").data(), in.at("a").data(), dq.data(), M.data());
  const Values expected = generic_results(compilation, in);
  expect_near(dq, expected.at("dtau_dq"), "dtau_dq");
  expect_near(M, expected.at("M"), "M");
}

TEST(EmittedDerivatives, PassTheirSelftest) {
  const CompileOptions options = derivatives_only();
  const Compilation compilation = compile_robot("all_joints", Base::kFixed, options);
  const cli::TemporaryFolder folder;
  const cli::Library library(
      cli::build_library(compiler(), folder.path(), emit(target(compilation, options)),
                         {"all_joints_rnea_derivatives_double.cpp", "all_joints_selftest.cpp"}));
  EXPECT_EQ(reinterpret_cast<int (*)()>(library.symbol("main"))(), 0);
}

TEST(EmittedDerivatives, MayBeZeroByStructure) {
  Model model;
  model.name = "slide";
  model.file = "slide.urdf";
  model.root = 0;
  model.links = {{"rail", {}, {}}, {"sledge", Inertial{}, {}}};
  model.links[1].inertial->mass = 2;
  Joint joint;
  joint.name = "slide";
  joint.type = JointType::kPrismatic;
  joint.parent = 0;
  joint.child = 1;
  joint.axis = {1, 0, 0};
  model.joints = {joint};
  const CompileOptions options = derivatives_only();
  Diagnostics diagnostics;
  const Compilation compilation = compile(model, options, diagnostics);
  const TargetModel emitted = target(compilation, options);
  EXPECT_EQ(emitted.functions.front().entries(0), 0);
  const cli::GeneratedCode code(compiler(), emitted);
  const Values got = code.call("rnea_derivatives", {{"q", {0.5}}, {"v", {1}}, {"a", {1}}});
  EXPECT_EQ(got.at("dtau_dq"), std::vector<double>{0});
  EXPECT_EQ(got.at("dtau_dv"), std::vector<double>{0});
  EXPECT_EQ(got.at("M"), std::vector<double>{2});
}

}  // namespace
}  // namespace arboc::test

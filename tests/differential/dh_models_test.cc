// The models that come as DH tables: one compiled human for every anthropometry, what that costs,
// and the arm that is here as a table and as URDF.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "frontend/read_model.h"
#include "support/engines.h"
#include "support/temp_dir.h"

namespace arboc::test {
namespace {

Model santos(const std::string& anthropometry = "") {
  Diagnostics diagnostics;
  return configure(read_model(own_model_path("santos"), diagnostics, anthropometry), {},
                   diagnostics);
}

FunctionOptions with_parameters(const std::vector<std::string>& parameters) {
  FunctionOptions options;
  options.parameters = parameters;
  return options;
}

/// The state, and parameters a few per cent off those of the model.
Values inputs_with(const Setup& setup, const State& state, Random& random) {
  Values in = inputs_of(state);
  for (const Parameter& p : setup.parameters) {
    in[p.name] = p.nominal;
    for (double& x : in[p.name]) x = x * random.uniform(0.95, 1.05) + random.uniform(0, 1e-3);
  }
  return in;
}

TEST(DhParameters, EveryGroupAgreesWithTheReference) {
  FunctionOptions options =
      with_parameters({"gravity", "masses", "cgs", "inertias", "lengths", "stiffness", "neutral"});
  options.joint_forces.stiffness = true;
  const Model model = santos();
  const auto setup = resolve(model, options);
  std::map<std::string, size_t> sizes;
  for (const Parameter& p : setup.parameters) sizes[p.name] = p.nominal.size();
  EXPECT_EQ(sizes, (std::map<std::string, size_t>{{"gravity", 3},
                                                  {"masses", 26},
                                                  {"centres", 78},
                                                  {"inertias", 156},
                                                  {"lengths", 26},
                                                  {"stiffness", 49},
                                                  {"neutral", 49}}));
  Random random(1);
  for (int k = 0; k < 3; ++k) {
    const Values in = inputs_with(setup, random_state(model, random), random);
    for (const char* function : {"fk", "rnea", "crba", "com", "gravity"}) {
      const Request request{function};
      for (const LoweringOptions& lowering : lowerings(function)) {
        const Values got = evaluate_generic(request, setup, lowering, in);
        for (const auto& [name, expected] : evaluate_reference(request, setup, in))
          EXPECT_LE(relative_error(got.at(name), expected), 1e-12) << function << "." << name;
      }
    }
  }
}

// Six-point differences of the reference: 1e-11 of the largest derivative, with a margin.
TEST(DhParameters, DerivativesAgreeWithDifferences) {
  FunctionOptions options = with_parameters({"masses", "lengths", "stiffness", "neutral"});
  options.joint_forces.stiffness = true;
  Random random(1);
  for (const std::string name : {"santos", "nine_dof"}) {
    const Model m = own_model(name);
    FunctionOptions o = options;
    if (name == "nine_dof") o = with_parameters({"masses", "lengths"});
    const auto setup = resolve(m, o);
    Request request;
    request.function = "rnea";
    request.output = "tau";
    request.derivative = Derivative::kJacobian;
    for (const Parameter& p : setup.parameters) request.with.push_back(p.name);
    const Values in = inputs_with(setup, random_state(m, random), random);
    const Values got = evaluate_generic(request, setup, {}, in);
    for (const auto& [output, expected] : evaluate_reference(request, setup, in))
      EXPECT_LE(relative_error(got.at(output), expected), 1e-9) << name << " " << output;
  }
}

// Compiled once, with the lengths and masses of another person as arguments.
TEST(DhParameters, OneCompiledHumanServesEveryAnthropometry) {
  const TempDir folder;
  const std::string path = folder.path() + "/tall.toml";
  FILE* file = std::fopen(path.c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fputs(
      "units = { length = \"cm\", angle = \"rad\" }\n[lengths]\nL8 = 28\nL13 = 28\nL19 = 45\nL24 = "
      "45\n[segments]\n\"R Up Leg\" = { mass = 11 }\n\"L Up Leg\" = { mass = 11 }\n",
      file);
  std::fclose(file);
  const Model tall = santos(path);

  Compilation compilation{resolve(santos(), with_parameters({"lengths", "masses"})), {}};
  compilation.functions.push_back(compile_function({"rnea"}, compilation.setup));
  CompileOptions options;
  options.requests = {{"rnea"}};
  cli::Common common;
  common.cxxflags = "-std=c++17 -O0";
  const cli::GeneratedCode code(common, target(compilation, options));

  const auto of_tall = resolve(tall, with_parameters({"lengths", "masses"}));
  Random random(1);
  for (int k = 0; k < 5; ++k) {
    const State state = random_state(tall, random);
    Values in = inputs_of(state);
    for (const Parameter& p : of_tall.parameters) in[p.name] = p.nominal;
    const Values got = code.call("rnea", in);
    const Eigen::VectorXd tau = Reference(tall).rnea(state.q, state.v, state.a);
    EXPECT_LE(relative_error(got.at("tau"), {tau.data(), tau.data() + tau.size()}), 1e-12);
  }
}

int operations(const Request& request, const std::vector<std::string>& parameters) {
  return compile_function(request, resolve(santos(), with_parameters(parameters)))
      .program.ops.total();
}

// The targets of the project, as ratios of operations.
TEST(DhParameters, CostLittle) {
  const int baked = operations({"rnea"}, {});
  EXPECT_LE(operations({"rnea"}, {"lengths", "masses"}), 1.6 * baked);
  EXPECT_LE(operations({"rnea"}, {"lengths", "masses", "cgs", "inertias"}), 2.2 * baked);
  Request gradient;
  gradient.function = "rnea";
  gradient.output = "tau";
  gradient.derivative = Derivative::kGradient;
  gradient.squares = true;
  gradient.with = {"q", "v", "a"};
  EXPECT_LE(operations(gradient, {}), 2.6 * baked);
}

// Afloat and at rest in the neutral posture nothing pushes a joint ([Thesis] Table A.9).
TEST(DhModels, SpringsRestAtTheNeutralPosture) {
  Model model = santos();
  model.gravity = {};
  JointForces springs;
  springs.stiffness = true;
  const Reference reference(model, springs);
  const Coordinates at = coordinates(model);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(55);
  const Eigen::VectorXd zero = q;
  EXPECT_GT(reference.rnea(q, zero, zero).cwiseAbs().maxCoeff(), 0.1);
  for (size_t k = 0; k < model.joints.size(); ++k)
    if (at.joint[k].q >= 0) q[at.joint[k].q] = model.joints[k].neutral;
  EXPECT_LT(reference.rnea(q, zero, zero).cwiseAbs().maxCoeff(), 1e-14);
}

// The same arm from its table and from URDF.
TEST(DhModels, ArmOfATableIsTheArmOfUrdf) {
  for (const Base base : {Base::kFile, Base::kFloating}) {
    ModelOptions options;
    options.base = base;
    const Model urdf = own_model("arm7", options), table = own_model("arm7_dh", options);
    const auto of_urdf = resolve(urdf), of_table = resolve(table);
    Random random(1);
    for (int k = 0; k < 10; ++k) {
      const Values in = inputs_of(random_state(urdf, random));
      for (const char* function : {"rnea", "crba", "aba", "com"}) {
        const Values a = evaluate_generic({function}, of_urdf, {}, in);
        const Values b = evaluate_generic({function}, of_table, {}, in);
        for (const auto& [name, expected] : a)
          EXPECT_LE(relative_error(b.at(name), expected), 1e-11) << function << "." << name;
      }
    }
  }
}

}  // namespace
}  // namespace arboc::test

// Limbs in lanes: the graph in lanes against the plain one, on models with planted limbs, on the
// project's own and on public robots; and that they are taken where operations say so.
#include <gtest/gtest.h>

#include <filesystem>

#include "functions/lane_trace.h"
#include "passes/passes.h"
#include "support/engines.h"
#include "support/limb_model.h"
#include "support/oracle.h"

namespace arboc::test {
namespace {

constexpr const char* kFunctions[] = {"rnea", "nle", "gravity", "crba", "aba", "rnea_derivatives"};

std::vector<std::vector<double>> inputs_of(const Graph& graph, const Values& in) {
  std::vector<std::vector<double>> values;
  for (const Port& port : graph.regions[0].inputs) values.push_back(in.at(port.name));
  return values;
}

/// Traces both ways over each lowering and compares at a few states.  Sums in another order differ
/// by rounding; forward dynamics multiplies it by the condition of M (tolerance()).
void expect_the_same(const Model& model, const std::string& function, int states) {
  const Reference reference(model);
  const Setup setup = resolve(model);
  for (const LoweringOptions& lowering : lowerings(function)) {
    const Traced plain = trace({function}, setup, lowering);
    const auto lanes = trace_in_lanes({function}, setup, lowering, plain.patterns);
    ASSERT_TRUE(lanes) << function;
    verify(*lanes);
    const Graph a = run_passes(plain.graph), b = run_passes(*lanes);
    Random random(3);
    for (int k = 0; k < states; ++k) {
      const State state = random_state(model, random);
      const Values in = arboc::test::inputs_of(state);
      const auto expected = evaluate(a, inputs_of(a, in)), got = evaluate(b, inputs_of(b, in));
      ASSERT_EQ(got.size(), expected.size());
      for (size_t p = 0; p < got.size(); ++p)
        EXPECT_LE(relative_error(got[p], expected[p]), tolerance(function, reference, state))
            << function << ", output " << p;
    }
  }
}

TEST(LimbsInLanes, EqualThePlainGraphOnPlantedLimbs) {
  for (const std::uint64_t seed : seeds(24)) {
    LimbModelOptions options;
    options.base = seed % 2 ? Base::kFixed : Base::kFloating;
    options.limbs = 2 + static_cast<int>(seed % 5);
    const Model model = limb_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
    for (const char* function : kFunctions) expect_the_same(model, function, 3);
    if (HasFatalFailure() || HasNonfatalFailure()) return;
  }
}

TEST(LimbsInLanes, WithForcesOfTheJoints) {
  for (const std::uint64_t seed : seeds(4)) {
    Model model = limb_model(seed, {});
    Random random(seed);
    for (Joint& joint : model.joints) {
      joint.damping = random.uniform(0, 2);
      joint.friction = random.uniform(0, 2);
      joint.stiffness = random.uniform(0, 20);
      joint.rotor_inertia = random.uniform(0, 1);
    }
    FunctionOptions options;
    options.joint_forces = {true, true, true, true};
    const arboc::Setup setup = resolve(model, options);
    const auto jacobian = [](const char* of) {
      return parse_request("--jacobian", Derivative::kJacobian, of);
    };
    for (const Request& request :
         {Request{"rnea"}, Request{"crba"}, Request{"rnea_derivatives"}, jacobian("rnea.tau:v,a,q"),
          jacobian("nle.nle:q"), jacobian("statics.tau:q")}) {
      const LoweringOptions lowering = lowerings(request.function)[0];
      const Traced plain = trace(request, setup, lowering);
      const auto lanes = trace_in_lanes(request, setup, lowering, plain.patterns);
      ASSERT_TRUE(lanes) << text(request);
      const Values in = arboc::test::inputs_of(random_state(model, random));
      const auto expected = evaluate(plain.graph, inputs_of(plain.graph, in));
      const auto got = evaluate(*lanes, inputs_of(*lanes, in));
      for (size_t p = 0; p < got.size(); ++p)
        EXPECT_LE(relative_error(got[p], expected[p]), 1e-12) << text(request) << ", seed " << seed;
    }
  }
}

struct Robot {
  const char* name;
  Base base;
  int groups, limbs;  ///< of the first group
};

constexpr Robot kRobots[] = {
    {"hyq", Base::kFloating, 1, 4},         {"anymal_b", Base::kFloating, 1, 4},
    {"solo12", Base::kFloating, 1, 4},      {"talos_reduced", Base::kFloating, 2, 2},
    {"romeo_small", Base::kFloating, 2, 2}, {"allegro_left_hand", Base::kFixed, 1, 4},
    {"baxter", Base::kFixed, 1, 2}};

void expect_limbs(const Model& model, int groups, int limbs) {
  const Setup setup = resolve(model);
  const auto found = limbs_in_lanes(setup, lowerings("rnea")[0]);
  ASSERT_EQ(static_cast<int>(found.size()), groups);
  EXPECT_EQ(found[0].limbs(), limbs);
  for (const char* function : {"rnea", "crba", "aba", "rnea_derivatives"}) {
    expect_the_same(model, function, 1);
    const CompiledFunction f = compile_function({function}, setup);
    ASSERT_TRUE(f.lanes) << function;
    EXPECT_LT(f.lanes->program.ops.cost(), f.program.ops.cost());
  }
}

TEST(LimbsInLanes, OwnModels) {
  ModelOptions floating;
  floating.base = Base::kFloating;
  expect_limbs(own_model("quadruped", floating), 1, 4);
  expect_limbs(own_model("humanoid", floating), 2, 2);
}

TEST(LimbsInLanes, PublicRobots) {
  int found = 0;
  for (const Robot& robot : kRobots) {
    const std::string path = oracle_urdf({robot.name, robot.base});
    if (!std::filesystem::exists(path)) continue;
    ++found;
    SCOPED_TRACE(robot.name);
    ModelOptions options;
    options.base = robot.base;
    expect_limbs(model_from(path, options), robot.groups, robot.limbs);
  }
  if (found == 0) GTEST_SKIP() << "no robots beside the checkout";
}

TEST(LimbsInLanes, NotWhereNothingRepeatsOrMoreThanSumsIsNeeded) {
  const arboc::Setup arm = resolve(own_model("ur5"));
  EXPECT_FALSE(compile_function({"rnea"}, arm).lanes);
  ModelOptions floating;
  floating.base = Base::kFloating;
  const Model model = own_model("quadruped", floating);
  const arboc::Setup setup = resolve(model);
  EXPECT_FALSE(compile_function({"minv"}, setup).lanes);
  EXPECT_FALSE(compile_function({"energy"}, setup).lanes);
  EXPECT_FALSE(compile_function({"rnea", Derivative::kVjp, "tau"}, setup).lanes);
  EXPECT_FALSE(compile_function({"energy", Derivative::kJacobian, "T"}, setup).lanes);
  const CompiledFunction jacobian = compile_function({"rnea", Derivative::kJacobian, "tau"}, setup);
  ASSERT_TRUE(jacobian.lanes);
  EXPECT_EQ(jacobian.lanes->program.ops.total(),
            compile_function({"rnea_derivatives"}, setup).lanes->program.ops.total());
  FunctionOptions plain, parameters;
  plain.simplify.limbs = false;
  parameters.parameters = {"gravity"};
  EXPECT_FALSE(compile_function({"rnea"}, resolve(model, plain)).lanes);
  EXPECT_FALSE(compile_function({"rnea"}, resolve(model, parameters)).lanes);
}

}  // namespace
}  // namespace arboc::test

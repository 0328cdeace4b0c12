// Jacobians that an algorithm has (functions/recursion.h): any inputs in any order, with loads,
// joint forces and parameters, against the reference engine; and that they are taken.
#include <gtest/gtest.h>

#include <array>
#include <set>

#include "functions/recursion.h"
#include "passes/passes.h"
#include "program/program.h"
#include "support/engines.h"
#include "support/random_model.h"

namespace arboc::test {
namespace {

constexpr const char* kRequests[] = {
    "rnea.tau:q,v,a,f_ext", "rnea.tau:f_ext,v", "rnea.tau:a,q",   "nle.nle:v,q",
    "nle.nle:f_ext",        "statics.tau:q",    "gravity.g:q",    "statics.tau:f_ext,q",
    "aba.qdd:tau,q",        "aba.qdd:v",        "aba.qdd:q,f_ext"};

Request jacobian_of(const std::string& text) {
  return parse_request("--jacobian", Derivative::kJacobian, text);
}

/// Two loaded links, the last of the file among them.
FunctionOptions loaded(const Model& model, Axes axes) {
  FunctionOptions options;
  options.axes = axes;
  options.external_forces = {model.links.back().name, model.links[model.links.size() / 2].name};
  return options;
}

void expect_agreement(const Model& model, const FunctionOptions& options, bool singular) {
  const Setup setup = resolve(model, options);
  StateSource source(3);
  const Values in = source.inputs(setup);
  for (const char* text : kRequests) {
    const Request request = jacobian_of(text);
    if (singular && request.function == "aba") continue;
    const Signature s = signature(request, setup);
    const Values expected = evaluate_reference(request, setup, in);
    for (const LoweringOptions& lowering : lowerings(request.function)) {
      const Values got = evaluate_generic(request, setup, lowering, in);
      for (const Argument& a : s.outputs) {
        // Solving with M amplifies by its condition.
        const double allowed = request.function == "aba" ? 1e-7 : a.tolerance;
        EXPECT_LE(relative_error(got.at(a.name), expected.at(a.name)), allowed)
            << text << " " << a.name;
      }
    }
  }
}

struct Kind {
  const char* name;
  RandomModelOptions options;
};
const Kind kKinds[] = {
    {"every_joint", {7}},
    {"floating", {7, Base::kFloating}},
    {"beyond_urdf", {5, Base::kFixed, true, true, true, true, true, false, true}},
    {"massless_leaves", {7, Base::kFloating, true, true, true, true, true, true}},
};

class RecursionJacobian : public testing::TestWithParam<Kind> {};

TEST_P(RecursionJacobian, IsThatOfTheReferenceEngine) {
  const bool singular = GetParam().options.massless_leaves;
  int k = 0;
  for (const std::uint64_t seed : seeds(9)) {
    const Model model = random_model(seed, GetParam().options);
    if (coordinates(model).nv == 0) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    FunctionOptions options =
        loaded(model, std::array{Axes::kLocal, Axes::kWorld, Axes::kAligned}[k++ % 3]);
    expect_agreement(model, options, singular);
    options.joint_forces.damping = options.joint_forces.stiffness = true;
    options.joint_forces.friction = options.joint_forces.rotor = true;
    options.parameters = {"gravity", "masses"};
    expect_agreement(model, options, singular);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, RecursionJacobian, testing::ValuesIn(kKinds),
                         [](const auto& kind) { return std::string(kind.param.name); });

int operations(const Request& request, const Setup& setup) {
  return compile_function(request, setup).program.ops.total();
}

TEST(JacobiansByRecursion, AreTakenWhereTheyAreCheaper) {
  ModelOptions floating;
  floating.base = Base::kFloating;
  for (const Model& model : {own_model("ur5"), own_model("quadruped", floating)}) {
    arboc::Setup setup = resolve(model);
    EXPECT_EQ(operations(jacobian_of("rnea.tau:q,v,a"), setup),
              operations({"rnea_derivatives"}, setup));
    EXPECT_EQ(operations(jacobian_of("aba.qdd:q,v,tau"), setup),
              operations({"aba_derivatives"}, setup));
    setup = resolve(model, loaded(model, Axes::kWorld));
    setup.frames = setup.loads;
    EXPECT_EQ(operations(jacobian_of("rnea.tau:f_ext"), setup),
              operations({"frame_jacobian"}, setup));
  }
}

/// What either way shows to be zero is left out: q's column of inverse dynamics has entries in the
/// recursion that the graph has not, and the other way round.
TEST(JacobiansByRecursion, AreAsSparseAsBothWaysShow) {
  ModelOptions floating;
  floating.base = Base::kFloating;
  for (const char* name : {"ur5", "all_joints", "humanoid"}) {
    const Model model = own_model(name, floating);
    const arboc::Setup setup = resolve(model, loaded(model, Axes::kAligned));
    const LoweringOptions lowering = lowerings("rnea").front();
    const Pattern all = trace({"rnea_derivatives"}, setup, lowering).patterns[0];
    std::set<std::pair<int, int>> places;
    for (size_t k = 0; k < all.row.size(); ++k) places.emplace(all.row[k], all.col[k]);
    const Pattern own = trace(jacobian_of("rnea.tau:q"), setup, lowering).patterns[0];
    EXPECT_GT(own.row.size(), places.size() / 2);
    for (size_t k = 0; k < own.row.size(); ++k)
      EXPECT_TRUE(places.contains({own.row[k], own.col[k]})) << name;
  }
}

TEST(JacobiansByRecursion, AreOfWholeRequestsOnly) {
  const Model model = own_model("all_joints");
  FunctionOptions options = loaded(model, Axes::kLocal);
  options.parameters = {"masses"};
  options.joint_forces.stiffness = true;
  const arboc::Setup setup = resolve(model, options);
  EXPECT_NE(recursion_of(jacobian_of("rnea.tau:a,f_ext"), setup), nullptr);
  EXPECT_NE(recursion_of(jacobian_of("aba.qdd:tau"), setup), nullptr);
  EXPECT_EQ(recursion_of(jacobian_of("rnea.tau"), setup), nullptr);  // by masses too
  EXPECT_EQ(recursion_of(jacobian_of("aba.qdd:f_ext"), setup), nullptr);
  EXPECT_EQ(recursion_of(jacobian_of("gravity.g:q"), setup), nullptr);  // springs
  EXPECT_EQ(recursion_of({"rnea"}, setup), nullptr);
}

}  // namespace
}  // namespace arboc::test

// The generic engine and the traced graph against the reference engine: every function, every
// lowering, on the project's models, on public robots where they are at hand, on random models.
#include <gtest/gtest.h>

#include <filesystem>

#include "passes/passes.h"
#include "support/engines.h"
#include "support/oracle.h"
#include "support/random_model.h"

namespace arboc::test {
namespace {

/// Output k of a traced function, dense: as generated code scatters it.
std::vector<double> dense(const Traced& traced, const Argument& a, size_t k,
                          const std::vector<double>& entries) {
  const Pattern& pattern = traced.patterns[k];
  if (!a.sparse) return entries;
  const auto n = static_cast<size_t>(a.cols);
  std::vector<double> out(static_cast<size_t>(a.rows) * n);
  for (size_t e = 0; e < pattern.row.size(); ++e) {
    const auto row = static_cast<size_t>(pattern.row[e]), col = static_cast<size_t>(pattern.col[e]);
    out[row * n + col] = entries[e];
    if (a.symmetric) out[col * n + row] = entries[e];
  }
  return out;
}

void expect_agreement(const Model& model, int states) {
  const Reference reference(model);
  for (const std::string& function : functions_of(model)) {
    for (const LoweringOptions& lowering : lowerings(function)) {
      SCOPED_TRACE(function + (lowering.frames == FrameChoice::kAxis ? ", axis" : ", denavit"));
      const Setup setup = resolve(model);
      const Signature s = signature({function}, setup);
      Traced traced = trace({function}, setup, lowering);
      traced.graph = run_passes(std::move(traced.graph));
      Random random(11);
      for (int k = 0; k < states; ++k) {
        const State state = random_state(model, random);
        const Values in = inputs_of(state);
        const Values expected = evaluate_reference({function}, setup, in);
        const Values generic = evaluate_generic({function}, setup, lowering, in);
        std::vector<std::vector<double>> arguments;
        for (const Argument& a : s.inputs) arguments.push_back(in.at(a.name));
        const auto results = evaluate(traced.graph, arguments);
        for (size_t o = 0; o < s.outputs.size(); ++o) {
          const Argument& a = s.outputs[o];
          const double allowed = std::max(a.tolerance, tolerance(function, reference, state));
          EXPECT_LE(relative_error(generic.at(a.name), expected.at(a.name)), allowed)
              << a.name << ", generic, state " << k;
          EXPECT_LE(relative_error(dense(traced, a, o, results[o]), expected.at(a.name)), allowed)
              << a.name << ", graph, state " << k;
        }
      }
    }
  }
}

struct Case {
  const char* name;
  Base base = Base::kFile;
  MimicPolicy mimic = MimicPolicy::kFollow;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class OwnModels : public testing::TestWithParam<Case> {};

TEST_P(OwnModels, Agree) {
  ModelOptions options;
  options.base = GetParam().base;
  options.mimic = GetParam().mimic;
  expect_agreement(own_model(GetParam().name, options), 3);
}

constexpr auto kFloating = Base::kFloating;
constexpr Case kCases[] = {{"double_pendulum"},
                           {"double_pendulum", kFloating},
                           {"ur5"},
                           {"ur5", kFloating},
                           {"arm7"},
                           {"arm7", kFloating},
                           {"all_joints"},
                           {"all_joints", kFloating},
                           {"all_joints", kFloating, MimicPolicy::kIndependent},
                           {"quadruped"},
                           {"quadruped", kFloating},
                           {"humanoid", kFloating},
                           {"santos"},
                           {"santos", kFloating},
                           {"nine_dof"},
                           {"arm7_dh"},
                           {"astronaut_turn"},
                           {"astronaut_ladder"}};

INSTANTIATE_TEST_SUITE_P(Models, OwnModels, testing::ValuesIn(kCases), [](const auto& c) {
  return std::string(c.param.name) + (c.param.base == kFloating ? "_floating" : "") +
         (c.param.mimic == MimicPolicy::kIndependent ? "_independent" : "");
});

class PublicRobots : public testing::TestWithParam<OracleRobot> {};

TEST_P(PublicRobots, Agree) {
  const std::string path = oracle_urdf(GetParam());
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  ModelOptions options;
  options.base = GetParam().base;
  expect_agreement(model_from(path, options), 2);
}

INSTANTIATE_TEST_SUITE_P(Robots, PublicRobots, testing::ValuesIn(oracle_robots()),
                         [](const auto& robot) { return std::string(robot.param.name); });

class RandomModels : public testing::TestWithParam<Base> {
 protected:
  static void expect_all_agree(RandomModelOptions options, int models) {
    options.base = GetParam();
    for (const std::uint64_t seed : seeds(models)) {
      const Model model = random_model(seed, options);
      if (coordinates(model).nv == 0) continue;
      SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
      expect_agreement(model, 2);
      if (HasFailure()) return;
    }
  }
};

TEST_P(RandomModels, OfEveryJointTypeAgree) { expect_all_agree({}, 30); }

TEST_P(RandomModels, OfManyJointsAgree) {
  RandomModelOptions options;
  options.joints = 30;
  expect_all_agree(options, 4);
}

TEST_P(RandomModels, OfJointsBeyondUrdfAgree) {
  RandomModelOptions options;
  options.exotic = true;
  options.joints = 6;
  expect_all_agree(options, 15);
}

TEST_P(RandomModels, WithoutMimicJointsAgree) {
  RandomModelOptions options;
  options.mimic = false;
  expect_all_agree(options, 20);
}

TEST_P(RandomModels, WithMasslessLeavesAgree) {
  RandomModelOptions options;
  options.massless_leaves = true;
  expect_all_agree(options, 20);
}

INSTANTIATE_TEST_SUITE_P(Bases, RandomModels, testing::Values(Base::kFixed, Base::kFloating),
                         [](const auto& base) {
                           return base.param == Base::kFixed ? "Fixed" : "Floating";
                         });

}  // namespace
}  // namespace arboc::test

// Compiled code against the reference engine, every function.
//
// With and without fused multiply-adds: -march=native has them where the machine does, the default
// target of x86 has not, and takes the C library's sine.
#include <gtest/gtest.h>

#include "support/engines.h"
#include "support/random_model.h"

namespace arboc::test {
namespace {

constexpr const char* kNative = "-std=c++17 -O1 -march=native -fno-tree-vectorize";
constexpr const char* kPlain = "-std=c++17 -O1";

void expect_agreement(const Model& model, const char* flags, int states = 20) {
  const Reference reference(model);
  const Setup setup = resolve(model);
  const std::vector<std::string> functions = functions_of(model);
  const cli::GeneratedCode code = generated_code(model, functions, flags);
  Random random(5);
  for (int k = 0; k < states; ++k) {
    const State state = random_state(model, random);
    const Values in = inputs_of(state);
    for (const std::string& function : functions) {
      int status = -1;
      const Values got = code.call(function, in, &status);
      EXPECT_EQ(status, 0) << function;
      for (const auto& [name, expected] : evaluate_reference({function}, setup, in))
        EXPECT_LE(relative_error(got.at(name), expected), tolerance(function, reference, state))
            << function << ", state " << k;
    }
  }
}

ModelOptions floating() {
  ModelOptions options;
  options.base = Base::kFloating;
  return options;
}

TEST(GeneratedCode, AgreesOnUr5) { expect_agreement(own_model("ur5"), kNative); }
TEST(GeneratedCode, AgreesOnAllJoints) { expect_agreement(own_model("all_joints"), kPlain); }
TEST(GeneratedCode, AgreesOnFloatingAllJoints) {
  expect_agreement(own_model("all_joints", floating()), kNative);
}
TEST(GeneratedCode, AgreesOnFloatingQuadruped) {
  expect_agreement(own_model("quadruped", floating()), kNative);
}
// Its legs are in vectors of four, which this target takes apart.
TEST(GeneratedCode, AgreesOnFloatingQuadrupedWithoutWideVectors) {
  expect_agreement(own_model("quadruped", floating()), kPlain, 5);
}

TEST(GeneratedCode, AgreesOnRandomModels) {
  for (const std::uint64_t seed : seeds(4)) {
    RandomModelOptions options;
    options.base = seed % 2 ? Base::kFixed : Base::kFloating;
    options.joints = 7;
    const Model model = random_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
    expect_agreement(model, kPlain, 5);
  }
}

TEST(GeneratedCode, AgreesOnJointsBeyondUrdf) {
  for (const std::uint64_t seed : seeds(2)) {
    RandomModelOptions options;
    options.exotic = true;
    options.joints = 5;
    const Model model = random_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
    expect_agreement(model, kPlain, 5);
  }
}

}  // namespace
}  // namespace arboc::test

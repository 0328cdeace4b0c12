// Limbs one after the other through shared functions: the program against its graph, compiled code
// against the plain one, and that the text is shorter.
#include <gtest/gtest.h>

#include "functions/lane_trace.h"
#include "passes/passes.h"
#include "support/engines.h"
#include "support/interpreter.h"
#include "support/limb_model.h"

namespace arboc::test {
namespace {

constexpr const char* kFunctions[] = {"rnea", "nle", "gravity", "crba", "aba", "rnea_derivatives"};

Compilation compilation_by(const Model& model, const std::vector<std::string>& functions,
                           bool shared) {
  FunctionOptions options;
  options.simplify.limbs = shared;
  options.optimise = shared ? Optimise::kSize : Optimise::kSpeed;
  Compilation compilation{resolve(model, options), {}};
  for (const Request& request : requests_of(functions))
    compilation.functions.push_back(compile_function(request, compilation.setup));
  return compilation;
}

cli::GeneratedCode code_of(const Compilation& compilation) {
  cli::Common common;
  common.cxxflags = "-std=c++17 -O1";
  CompileOptions options;
  for (const CompiledFunction& f : compilation.functions) options.requests.push_back(f.request);
  return {common, target(compilation, options)};
}

/// Functions whose limbs are shared, compiled: results equal the plain ones'.
void expect_shared(const Model& model, const std::vector<std::string>& functions, int states) {
  const Compilation shared = compilation_by(model, functions, true),
                    plain = compilation_by(model, functions, false);
  for (size_t k = 0; k < functions.size(); ++k) {
    const CompiledFunction& f = shared.functions[k];
    ASSERT_TRUE(f.program.by_limb) << functions[k];
    EXPECT_FALSE(f.lanes);
    EXPECT_LT(count_listed(f.program).total(), plain.functions[k].program.ops.total());
  }
  const cli::GeneratedCode a = code_of(plain), b = code_of(shared);
  const Reference reference(model);
  Random random(5);
  for (int s = 0; s < states; ++s) {
    const State state = random_state(model, random);
    for (const std::string& function : functions) {
      const Values expected = a.call(function, inputs_of(state));
      for (const auto& [name, values] : b.call(function, inputs_of(state)))
        EXPECT_LE(relative_error(values, expected.at(name)), tolerance(function, reference, state))
            << function << "." << name;
    }
  }
}

TEST(SharedLimbs, CompiledEqualThePlainTextOnQuadruped) {
  ModelOptions floating;
  floating.base = Base::kFloating;
  expect_shared(own_model("quadruped", floating), {std::begin(kFunctions), std::end(kFunctions)},
                5);
}

TEST(SharedLimbs, CompiledEqualThePlainTextOnTwoLegsAndTwoArms) {
  ModelOptions floating;
  floating.base = Base::kFloating;
  expect_shared(own_model("humanoid", floating), {"rnea", "crba", "aba"}, 5);
}

TEST(SharedLimbs, CompiledEqualThePlainTextOnPlantedLimbs) {
  for (const std::uint64_t seed : seeds(3)) {
    LimbModelOptions options;
    options.limbs = 2 + static_cast<int>(seed % 3);
    const Model model = limb_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
    expect_shared(model, {"rnea", "crba", "rnea_derivatives"}, 3);
  }
}

TEST(SharedLimbs, ProgramsKeepTheValueOfTheirGraph) {
  for (const std::uint64_t seed : seeds(24)) {
    LimbModelOptions options;
    options.base = seed % 2 ? Base::kFixed : Base::kFloating;
    options.limbs = 2 + static_cast<int>(seed % 5);
    const Model model = limb_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
    const arboc::Setup setup = resolve(model);
    Random random(seed);
    for (const char* function : kFunctions) {
      const LoweringOptions lowering = lowerings(function)[0];
      const Traced plain = trace({function}, setup, lowering);
      const Graph graph = run_passes(*trace_in_lanes({function}, setup, lowering, plain.patterns));
      const Values in = inputs_of(random_state(model, random));
      std::vector<std::vector<double>> values;
      for (const Port& port : graph.regions[0].inputs) values.push_back(in.at(port.name));
      const Program program = schedule(graph, {40, true});
      for (const Chunk& chunk : program.chunks)
        for (const Statement& s : chunk.statements)
          EXPECT_TRUE(chunk.limbs > 0 ? s.width > 1 && chunk.limbs <= s.width : s.width == 1);
      EXPECT_EQ(interpret(program, values), evaluate(graph, values)) << function;
    }
  }
}

}  // namespace
}  // namespace arboc::test

// Passes on random graphs: the value stays, and no graph gets more expensive.
#include <gtest/gtest.h>

#include <cmath>

#include "passes/dead.h"
#include "passes/fuse.h"
#include "passes/passes.h"
#include "program/program.h"
#include "support/random.h"
#include "support/random_graph.h"
#include "support/rounding_bound.h"

namespace arboc::test {
namespace {

constexpr int kSeeds = 300;

/// Small graphs meet corner cases, large ones mix the rules.
Graph some_graph(std::uint64_t seed) {
  RandomGraphOptions options;
  options.nodes = seed % 3 == 0 ? 12 : seed % 3 == 1 ? 60 : 400;
  return random_graph(seed, options);
}

/// Largest difference as a multiple of the bound.
double difference(const Graph& before, const Graph& after, std::uint64_t seed) {
  const auto inputs = random_inputs(before, seed);
  const auto a = evaluate(before, inputs), b = evaluate(after, inputs);
  const auto bound = rounding_bound(before, inputs);
  double worst = 0;
  for (size_t p = 0; p < a.size(); ++p)
    for (size_t i = 0; i < a[p].size(); ++i) {
      if (a[p][i] == b[p][i]) continue;
      const double ratio = std::fabs(a[p][i] - b[p][i]) / bound[p][i];
      if (!(ratio <= worst)) worst = ratio;
    }
  return worst;
}

TEST(RandomGraphs, TextRoundTripKeepsEveryBit) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Graph graph = some_graph(seed);
    const Graph again = parse(print(graph));
    verify(again);
    const auto inputs = random_inputs(graph, seed);
    ASSERT_EQ(evaluate(again, inputs), evaluate(graph, inputs)) << "ARBOC_SEED=" << seed;
    const std::string settled = print(again);
    ASSERT_EQ(print(parse(settled)), settled) << "ARBOC_SEED=" << seed;
  }
}

TEST(RandomGraphs, TextRoundTripAfterPasses) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Graph graph = run_passes(some_graph(seed));
    const auto inputs = random_inputs(graph, seed);
    ASSERT_EQ(evaluate(parse(print(graph)), inputs), evaluate(graph, inputs))
        << "ARBOC_SEED=" << seed;
  }
}

TEST(RandomGraphs, RemoveDeadKeepsEveryBit) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Graph before = some_graph(seed), after = remove_dead(before);
    verify(after);
    const auto inputs = random_inputs(before, seed);
    ASSERT_EQ(evaluate(after, inputs), evaluate(before, inputs)) << "ARBOC_SEED=" << seed;
    EXPECT_LE(after.regions[0].nodes.size(), before.regions[0].nodes.size());
    EXPECT_EQ(print(remove_dead(after)), print(after)) << "ARBOC_SEED=" << seed;
  }
}

TEST(RandomGraphs, FuseStaysWithinRounding) {
  double worst = 0;
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Graph before = some_graph(seed), after = fuse(before);
    verify(after);
    const double ratio = difference(before, after, seed);
    ASSERT_LE(ratio, 1) << "ARBOC_SEED=" << seed;
    worst = std::max(worst, ratio);
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(RandomGraphs, FuseNeverCostsOperations) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Graph before = remove_dead(some_graph(seed));
    const OpCount a = schedule(before).ops, b = schedule(run_passes(before)).ops;
    EXPECT_LE(b.total(), a.total()) << "ARBOC_SEED=" << seed;
    EXPECT_LE(b.mul + b.fma, a.mul + a.fma + a.add) << "ARBOC_SEED=" << seed;
    EXPECT_LE(b.div, a.div);
    EXPECT_LE(b.sqrt, a.sqrt);
    EXPECT_LE(b.sincos, a.sincos);
  }
}

TEST(RandomGraphs, FuseLeavesTheFormThatItsHeaderStates) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Graph graph = remove_dead(fuse(some_graph(seed)));
    const Region& region = graph.regions[0];
    for (const Node& node : region.nodes) {
      ASSERT_NE(node.op, Op::kAdd) << "ARBOC_SEED=" << seed;
      if (node.op != Op::kSum) continue;
      int positive = 0;
      for (std::uint32_t t = node.index; t < node.index + node.count; ++t)
        positive += region.terms[t].a.negative() ? 0 : 1;
      EXPECT_EQ(positive == 0, region.terms[node.index].a.negative()) << "ARBOC_SEED=" << seed;
      for (std::uint32_t t = node.index + 2; t < node.index + node.count; ++t)
        EXPECT_LE(region.terms[t - 1].product, region.terms[t].product) << "ARBOC_SEED=" << seed;
    }
  }
}

}  // namespace
}  // namespace arboc::test

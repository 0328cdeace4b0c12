// Programs of random graphs: run statement by statement, they are evaluate() bit for bit, however
// they are cut; and their operation counts are those of their text.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "passes/passes.h"
#include "program/program.h"
#include "support/interpreter.h"
#include "support/random.h"
#include "support/random_graph.h"

namespace arboc::test {
namespace {

constexpr int kSeeds = 200;

Graph some_graph(std::uint64_t seed, bool passes) {
  RandomGraphOptions options;
  options.nodes = seed % 2 == 0 ? 40 : 600;
  Graph graph = random_graph(seed, options);
  return passes ? run_passes(std::move(graph)) : graph;
}

class Chunks : public testing::TestWithParam<int> {};

TEST_P(Chunks, ProgramIsTheGraphBitForBit) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    for (const bool passes : {false, true}) {
      const Graph graph = some_graph(seed, passes);
      const Program program = schedule(graph, {.chunk_ops = GetParam()});
      const auto inputs = random_inputs(graph, seed);
      ASSERT_EQ(interpret(program, inputs), evaluate(graph, inputs)) << "ARBOC_SEED=" << seed;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Operations, Chunks, testing::Values(1, 7, 250));

/// Operations of one printed statement `x1 = ...`.
void recount(const std::string& right, OpCount& ops) {
  std::istringstream words(right);
  int stars = 0, signs = 0, divisions = 0;
  for (std::string word; words >> word;) {
    stars += word == "*";
    divisions += word == "/";
    signs += word == "+" || word == "-";
    ops.sqrt += word.starts_with("sqrt(");
    ops.sincos += word.starts_with("sin(") || word.starts_with("cos(");
  }
  // Every sign joins two terms; a product becomes one fused operation with one of them.
  const int atoms = signs + 1 - stars;
  ops.div += divisions;
  ops.fma += atoms > 0 ? (signs > 0 ? stars : 0) : stars - 1;
  ops.mul += atoms > 0 ? 0 : 1;
  ops.add += atoms > 0 ? atoms - 1 : 0;
}

TEST(Programs, CountsAreThoseOfTheText) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Program program = schedule(some_graph(seed, true));
    OpCount ops;
    std::istringstream lines(print(program));
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with('x')) recount(line.substr(line.find(" = ") + 3), ops);
      ops.sincos += line.find(" = sincos(") != std::string::npos;
    }
    EXPECT_EQ(ops.mul, program.ops.mul) << "ARBOC_SEED=" << seed;
    EXPECT_EQ(ops.add, program.ops.add) << "ARBOC_SEED=" << seed;
    EXPECT_EQ(ops.fma, program.ops.fma) << "ARBOC_SEED=" << seed;
    EXPECT_EQ(ops.div, program.ops.div) << "ARBOC_SEED=" << seed;
    EXPECT_EQ(ops.sqrt, program.ops.sqrt) << "ARBOC_SEED=" << seed;
    EXPECT_EQ(ops.sincos, program.ops.sincos) << "ARBOC_SEED=" << seed;
  }
}

TEST(Programs, ChunksAreAsLongAsAskedFor) {
  for (const std::uint64_t seed : seeds(20)) {
    RandomGraphOptions options;
    options.nodes = 2000;
    options.outputs = 200;
    const Program program = schedule(run_passes(random_graph(seed, options)), {.chunk_ops = 100});
    ASSERT_GT(program.chunks.size(), 3u);
    for (const Chunk& chunk : program.chunks) {
      Program alone;
      alone.chunks = {chunk};
      // One statement may exceed the limit by its own length; a short rest joins the last chunk.
      EXPECT_LT(count_ops(alone).total(), 100 + 20 + 40) << "ARBOC_SEED=" << seed;
    }
  }
}

TEST(Programs, SlotsAreReused) {
  for (const std::uint64_t seed : seeds(20)) {
    RandomGraphOptions options;
    options.nodes = 2000;
    options.outputs = 50;
    const Program program = schedule(run_passes(random_graph(seed, options)), {.chunk_ops = 20});
    int kept = 2 * static_cast<int>(program.angles.size());
    for (const Chunk& chunk : program.chunks)
      kept += static_cast<int>(std::count_if(chunk.statements.begin(), chunk.statements.end(),
                                             [](const Statement& s) { return s.slot >= 0; }));
    EXPECT_LT(program.slots, kept) << "ARBOC_SEED=" << seed;
  }
}

}  // namespace
}  // namespace arboc::test

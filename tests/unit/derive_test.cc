// Derivatives of small expressions of a, b, c as they are printed, and graphs that are deep.
#include <gtest/gtest.h>

#include <cmath>

#include "derive/cost.h"
#include "derive/hessian.h"
#include "derive/jacobian.h"
#include "derive/reverse.h"
#include "passes/dead.h"
#include "passes/passes.h"
#include "program/program.h"
#include "support/expression.h"
#include "support/random.h"
#include "support/random_graph.h"
#include "support/replay.h"

namespace arboc::test {
namespace {

std::vector<Coordinate> first_inputs(Replay& r, size_t n) {
  return coordinates_of(r.builder, "q", {r.inputs.begin(), r.inputs.begin() + n});
}

std::string printed(Replay& r, const std::vector<Ref>& entries) {
  r.builder.output("d", entries);
  return expressions_of(remove_dead(std::move(r.builder).finish()));
}

struct Case {
  const char* value;
  const char* derivatives;  ///< by a, by b
};

const Case kRules[] = {
    {"3", "0; 0"},
    {"-a", "-1; 0"},
    {"a + b", "1; 1"},
    {"a - b", "1; -1"},
    {"2 * a - 3 * b", "2; -3"},
    {"a * b", "b; a"},
    {"a * a", "2 * a; 0"},
    {"c * a", "c; 0"},
    {"a / b", "1 / b; -((a / b) * (1 / b))"},
    {"sqrt(a)", "0.5 / sqrt(a); 0"},
    {"sin(a)", "cos(a); 0"},
    {"cos(-a)", "-sin(a); 0"},
    {"sin(a * b)", "b * cos(a * b); a * cos(a * b)"},
};

class Rules : public testing::TestWithParam<Case> {};

TEST_P(Rules, Forward) {
  Replay r = replay(graph_of(GetParam().value));
  const SparseMatrix J = jacobian(r.builder, r.outputs, first_inputs(r, 2), Direction::kForward);
  std::vector<Ref> dense(2, r.builder.constant(0));
  for (size_t e = 0; e < J.value.size(); ++e) dense[static_cast<size_t>(J.col[e])] = J.value[e];
  EXPECT_EQ(printed(r, dense), GetParam().derivatives);
}

TEST_P(Rules, Reverse) {
  Replay r = replay(graph_of(GetParam().value));
  const std::vector<Ref> g = gradient(r.builder, r.outputs[0], first_inputs(r, 2));
  EXPECT_EQ(printed(r, g), GetParam().derivatives);
}

INSTANTIATE_TEST_SUITE_P(Table, Rules, testing::ValuesIn(kRules));

/// x' = c x - s y and y' = s x + c y: the angle takes y' and -x' times the adjoints b and c.
TEST(Reverse, TurnedVectorsAreUsedAsAWhole) {
  Replay r = replay(graph_of("b * (cos(a) * d - sin(a) * e) + c * (sin(a) * d + cos(a) * e)"));
  EXPECT_EQ(printed(r, gradient(r.builder, r.outputs[0], first_inputs(r, 1))),
            "(c * ((d * cos(a)) - (e * sin(a)))) - (b * ((d * sin(a)) + (e * cos(a))))");
}

TEST(Jacobian, KeepsStructuralNonZerosByColumns) {
  for (const Direction direction :
       {Direction::kForward, Direction::kReverse, Direction::kCheapest}) {
    Replay r = replay(graph_of("a * b; 2 * b; c"));
    const SparseMatrix J = jacobian(r.builder, r.outputs, first_inputs(r, 3), direction);
    EXPECT_EQ(J.row, (std::vector<int>{0, 0, 1, 2}));
    EXPECT_EQ(J.col, (std::vector<int>{0, 1, 1, 2}));
    EXPECT_EQ(printed(r, J.value), "b; a; 2; 1");
  }
}

TEST(Jacobian, TakesTheCheaperDirection) {
  const char* kWide = "sin(a * b * c * d)";
  const char* kTall = "sin(a) * b; sin(a) * c; sin(a) * d";
  Replay wide = replay(graph_of(kWide)), wide_forward = wide;
  const auto by = [](Replay& r, size_t n, Direction direction) {
    const SparseMatrix J = jacobian(r.builder, r.outputs, first_inputs(r, n), direction);
    return estimated_cost(r.builder.region(), J.value);
  };
  EXPECT_LT(by(wide, 4, Direction::kCheapest), by(wide_forward, 4, Direction::kForward));
  Replay tall = replay(graph_of(kTall)), tall_forward = tall;
  EXPECT_EQ(by(tall, 1, Direction::kCheapest), by(tall_forward, 1, Direction::kForward));
}

/// A node that is seeded is not looked into; paths around it go on to the inputs.
TEST(Barrier, ReplacesTheChainRule) {
  for (const Direction direction : {Direction::kForward, Direction::kReverse}) {
    Replay r = replay(graph_of("sin(a) * b; cos(a); sin(a)"));
    const Ref a = r.inputs[0], b = r.inputs[1], c = r.inputs[2], d = r.inputs[3];
    const std::vector<Coordinate> by{{"t", {{r.outputs[2], c}, {a, d}}, -1},
                                     {"b", {{b, r.builder.constant(1)}}, -1}};
    const SparseMatrix J = jacobian(r.builder, {r.outputs[0], r.outputs[1]}, by, direction);
    EXPECT_EQ(printed(r, J.value), "b * c; -(d * sin(a)); sin(a)");
  }
}

/// Also where only the constant stands between the seeded node and the input.
TEST(Barrier, HoldsForMultiples) {
  for (const Direction direction : {Direction::kForward, Direction::kReverse}) {
    Replay r = replay(graph_of("sin(2 * a) * c + (2 * a) * b; 2 * a"));
    const std::vector<Coordinate> by{{"t", {{r.outputs[1], r.inputs[3]}}, -1}};
    const SparseMatrix J = jacobian(r.builder, {r.outputs[0]}, by, direction);
    EXPECT_EQ(printed(r, J.value), direction == Direction::kForward
                                       ? "(c * (d * cos(2 * a))) + (b * d)"
                                       : "d * (b + (c * cos(2 * a)))");
  }
}

TEST(Hessian, UpperTriangleAndBlocks) {
  Replay r = replay(graph_of("a * a * b + sin(c) * a"));
  const auto q = first_inputs(r, 2);
  const auto v = coordinates_of(r.builder, "v", {r.inputs[2]});
  const WeightedSum sum{r.outputs, {r.builder.constant(1)}};
  const auto H = hessian(r.builder, sum, {q, v}, {{0, 0}, {0, 1}, {1, 1}});
  EXPECT_EQ(H[0].row, (std::vector<int>{0, 0}));
  EXPECT_EQ(H[0].col, (std::vector<int>{0, 1}));
  EXPECT_EQ(H[1].row, (std::vector<int>{0}));
  std::vector<Ref> all;
  for (const SparseMatrix& part : H) all.insert(all.end(), part.value.begin(), part.value.end());
  EXPECT_EQ(printed(r, all), "2 * b; 2 * a; cos(c); -(a * sin(c))");
}

/// Along x -> x, y and y -> 0, x: the orders differ by the commutator.
TEST(Hessian, GroupsTakeTheMeanOfBothOrders) {
  Replay r = replay(graph_of("c * b"));
  const Ref x = r.inputs[0], y = r.inputs[1], one = r.builder.constant(1);
  const std::vector<Coordinate> group{{"s", {{y, x}}, 7}, {"t", {{x, one}}, 7}};
  const WeightedSum sum{r.outputs, {one}};
  const SparseMatrix iterated = iterated_hessian(r.builder, sum, group);
  EXPECT_EQ(iterated.row, (std::vector<int>{0}));  // d_t d_s f = c, d_s d_t f = 0
  EXPECT_EQ(iterated.col, (std::vector<int>{1}));
  const auto H = hessian(r.builder, sum, {group}, {{0, 0}});
  EXPECT_EQ(printed(r, H[0].value), "0.5 * c");
}

/// A million nodes in a chain, each used twice: nothing recurses, nothing grows exponentially.
TEST(Derive, DeepChain) {
  Builder builder("chain");
  const std::vector<Ref> in = builder.input("x", 2);
  Ref x = in[0];
  for (int k = 0; k < 500000; ++k) x = builder.add(builder.mul(x, in[1]), in[0]);
  const auto by = coordinates_of(builder, "x", in);
  const size_t before = builder.region().nodes.size();
  const std::vector<Ref> g = gradient(builder, x, by);
  const SparseMatrix J = jacobian(builder, {x}, by, Direction::kForward);
  EXPECT_LT(builder.region().nodes.size(), 12 * before);
  builder.output("g", g);
  builder.output("J", J.value);
  // x = sum_{k <= n} a b^k -> a / (1 - b)
  const auto values = evaluate(std::move(builder).finish(), {{2, 0.5}});
  for (const auto& d : values) {
    EXPECT_NEAR(d[0], 2, 1e-12);
    EXPECT_NEAR(d[1], 8, 1e-12);
  }
}

TEST(Cost, EstimatesWhatScheduleCounts) {
  for (const std::uint64_t seed : seeds(50)) {
    const Graph graph = random_graph(seed);
    std::vector<Ref> roots;
    for (const auto& port : graph.regions[0].results)
      roots.insert(roots.end(), port.begin(), port.end());
    const int counted = schedule(run_passes(graph)).ops.total();
    EXPECT_NEAR(estimated_cost(graph.regions[0], roots), counted, 2 + counted / 10)
        << "ARBOC_SEED=" << seed;
  }
}

}  // namespace
}  // namespace arboc::test

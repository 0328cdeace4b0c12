// verify() names each broken invariant; evaluate() computes what the printed form says.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "graph/graph.h"

namespace arboc::test {
namespace {

Graph good() {
  return parse(
      "region f\nin q 2\nx2 = q0 * q1\nx4 = 2.5 + x2\nx5 = sum(x4, q0*x2)\nout y 2: x5 -q1\n");
}

struct Broken {
  const char* message;
  std::function<void(Region&)> breaks;
};

TEST(Verify, AcceptsWhatBuilderMakes) { EXPECT_NO_THROW(verify(good())); }

TEST(Verify, NamesEachBrokenInvariant) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Broken cases[] = {
      {"region f, node 2: unknown block", [](Region& r) { r.nodes[2].block = 9; }},
      {"region f, node 1: unknown input", [](Region& r) { r.nodes[1].index = 2; }},
      {"region f, node 2: operand behind its user", [](Region& r) { r.nodes[2].b = Ref(2); }},
      {"region f, node 4: operand behind its user", [](Region& r) { r.nodes[4].a = Ref(5, true); }},
      {"region f, node 5: operand behind its user", [](Region& r) { r.terms[1].b = Ref(70); }},
      {"region f, node 5: bad terms", [](Region& r) { r.nodes[5].count = 1; }},
      {"region f, node 5: bad terms", [](Region& r) { r.terms.pop_back(); }},
      {"region f, node 3: bad constant", [](Region& r) { r.constants.clear(); }},
      {"region f, node 3: constant not finite and non-negative",
       [](Region& r) { r.constants[0] = -2.5; }},
      {"region f, node 3: constant not finite and non-negative",
       [](Region& r) { r.constants[0] = kInfinity; }},
      {"region f, node 3: constant not finite and non-negative",
       [](Region& r) { r.constants[0] = std::nan(""); }},
      {"region f: outputs without results", [](Region& r) { r.results.clear(); }},
      {"region f: output 0 has the wrong size", [](Region& r) { r.results[0].pop_back(); }},
      {"region f: result out of range", [](Region& r) { r.results[0][0] = Ref(6); }},
  };
  for (const Broken& broken : cases) {
    Graph graph = good();
    broken.breaks(graph.regions[0]);
    try {
      verify(graph);
      ADD_FAILURE() << "accepted: " << broken.message;
    } catch (const std::logic_error& e) {
      EXPECT_STREQ(e.what(), broken.message);
    }
  }
  EXPECT_THROW(verify(Graph{}), std::logic_error);
}

TEST(Evaluate, EachOperation) {
  const Graph graph = parse(
      "region f\nin a 2\nin b 1\n"
      "x1 = a0 + -a1\nx2 = a0 * b0\nx3 = a0 / b0\nx4 = sqrt(a1)\nx5 = sin(b0)\nx6 = cos(b0)\n"
      "x7 = sum(a1, -a0*b0, x5)\n"
      "out y 7: x1 x2 x3 x4 x5 x6 -x7\nout z 2: -a1 0.5\n");
  const double a = 3, b = 2.25, c = 0.7;
  const auto out = evaluate(graph, {{a, b}, {c}});
  ASSERT_EQ(out.size(), 2u);
  const double sum = std::fma(-a, c, b) + std::sin(c);
  EXPECT_EQ(out[0],
            (std::vector<double>{a - b, a * c, a / c, 1.5, std::sin(c), std::cos(c), -sum}));
  EXPECT_EQ(out[1], (std::vector<double>{-b, 0.5}));
}

TEST(Evaluate, ProductsInsideSumsRoundOnce) {
  const Graph graph = parse("region f\nin a 3\nx1 = sum(a2, a0*a1)\nout y 1: x1\n");
  const double a = 1 + 0x1p-30, b = 1 - 0x1p-30;
  EXPECT_EQ(evaluate(graph, {{a, b, -1}})[0][0], -0x1p-60);
}

TEST(Evaluate, RefusesTheWrongNumberOfInputs) {
  EXPECT_THROW(evaluate(good(), {{1.0}}), std::invalid_argument);
  EXPECT_THROW(evaluate(good(), {{1.0, 2.0}, {3.0}}), std::invalid_argument);
}

}  // namespace
}  // namespace arboc::test

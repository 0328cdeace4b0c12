// print() and parse(): each reads what the other writes, and parse names the line that is wrong.
#include <gtest/gtest.h>

#include "graph/graph.h"

namespace arboc::test {
namespace {

constexpr const char* kEverything =
    "region everything\n"
    "in q 2\n"
    "in v 1\n"
    "x3 = q0 + -q1\n"
    "# first title, forward\n"
    "x5 = 2.5 * v0\n"
    "x6 = sin(x3)\n"
    "x7 = cos(x3)\n"
    "# second: a'b [c]\n"
    "x8 = x5 / x7\n"
    "x9 = sqrt(x8)\n"
    "x10 = sum(x6, -x7*x9, x5*x8, -v0)\n"
    "out y 2: -x10 q0\n"
    "out z 3: -1e-09 0 x9\n";

TEST(GraphText, RoundTrip) {
  const Graph graph = parse(kEverything);
  verify(graph);
  EXPECT_EQ(print(graph), kEverything);
}

TEST(GraphText, RoundTripOfSeveralRegions) {
  const std::string text =
      "region part\nin q 1\nx1 = sin(q0)\nout y 1: x1\n"
      "region whole\nin q 1\nx1 = cos(q0)\nout y 1: x1\n";
  const Graph graph = parse(text);
  ASSERT_EQ(graph.regions.size(), 2u);
  EXPECT_EQ(print(graph), text);
  EXPECT_EQ(evaluate(graph, {{0.0}})[0][0], 1);
}

TEST(GraphText, NumbersAreShortestAndExact) {
  const Graph graph = parse("region f\nin q 1\nx1 = 0.1 + q0\nx2 = 1e-300 * q0\nout y 2: x1 x2\n");
  EXPECT_EQ(evaluate(graph, {{0.2}})[0][0], 0.1 + 0.2);
  EXPECT_NE(print(graph).find("x2 = q0 + 0.1\nx4 = 1e-300 * q0\n"), std::string::npos)
      << print(graph);
  const Graph again = parse(print(graph));
  EXPECT_EQ(print(again), print(graph));
}

TEST(GraphText, EmptyPortsAndOutputs) {
  const std::string text = "region none\nin q 0\nout y 0:\n";
  EXPECT_EQ(print(parse(text)), text);
}

struct Wrong {
  const char* text;
  const char* message;
};

class WrongText : public testing::TestWithParam<Wrong> {};

TEST_P(WrongText, NamesTheLine) {
  try {
    parse(GetParam().text);
    FAIL() << "was accepted: " << GetParam().text;
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), GetParam().message);
  }
}

const Wrong kWrong[] = {
    {"region f\nx1 = q0 + 1\n", "line 2: x1 = q0 + 1: unknown operand q0"},
    {"region f\nin q 1\nx1 = q0 ^ 2\n", "line 3: x1 = q0 ^ 2: unknown operation ^"},
    {"region f\nin q 1\nx1 = tan(q0)\n", "line 3: x1 = tan(q0): unknown operation tan"},
    {"region f\nin q 1\nx1 = sum(q0)\n", "line 3: x1 = sum(q0): a sum has at least two terms"},
    {"region f\nin q 1\nx1 == q0\n", "line 3: x1 == q0: NAME = EXPRESSION"},
    {"region f\nin q\n", "line 2: in q: in NAME SIZE"},
    {"region f\nin q 1\nout y 2: q0\n", "line 3: out y 2: q0: out NAME SIZE: OPERAND ..."},
    {"region f\nin q 1\nregion g\nout y 1: q0\n", "line 4: out y 1: q0: unknown operand q0"},
};
INSTANTIATE_TEST_SUITE_P(Lines, WrongText, testing::ValuesIn(kWrong),
                         [](const auto& at) { return "case" + std::to_string(at.index + 1); });

}  // namespace
}  // namespace arboc::test

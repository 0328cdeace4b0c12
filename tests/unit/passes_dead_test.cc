// remove_dead(): what no output needs is gone, inputs and order stay.
#include "passes/dead.h"

#include <gtest/gtest.h>

#include "passes/passes.h"

namespace arboc::test {
namespace {

struct Case {
  const char* before;
  const char* after;
};

class RemoveDead : public testing::TestWithParam<Case> {};

TEST_P(RemoveDead, Table) {
  const Graph before = parse(std::string("region f\n") + GetParam().before);
  const Graph after = remove_dead(before);
  verify(after);
  EXPECT_EQ(print(after), std::string("region f\n") + GetParam().after);
  EXPECT_EQ(print(remove_dead(after)), print(after));
}

const Case kCases[] = {
    // A chain that ends nowhere.
    {"in q 2\nx2 = q0 + q1\nx3 = sin(x2)\nx4 = x3 * x2\nout y 1: x2\n",
     "in q 2\nx2 = q0 + q1\nout y 1: x2\n"},
    // Inputs stay, used or not, also in front of what remains; numbers close up.
    {"in q 2\nin v 3\nx5 = q0 * q1\nx6 = v0 * v1\nout y 1: -x6\n",
     "in q 2\nin v 3\nx5 = v0 * v1\nout y 1: -x5\n"},
    // Constants go with their users.
    {"in q 1\nx1 = 2.5 * q0\nx2 = 3.5 * q0\nx3 = 4.5 * q0\nout y 2: x2 -7\n",
     "in q 1\nx2 = 3.5 * q0\nout y 2: x2 -7\n"},
    // Both operands of products inside sums are needed.
    {"in q 3\nx3 = sin(q0)\nx4 = cos(q0)\nx5 = sqrt(q1)\nx6 = sum(q2, -x3*x5)\nx7 = sum(q1, "
     "x4*x6)\n"
     "out y 1: x6\n",
     "in q 3\nx3 = sin(q0)\nx4 = sqrt(q1)\nx5 = sum(q2, -x3*x4)\nout y 1: x5\n"},
    // Titles of blocks that lose all their nodes are not printed.
    {"in q 1\n# one\nx1 = sin(q0)\n# two\nx2 = cos(q0)\n# three\nx3 = sqrt(q0)\nout y 2: x1 x3\n",
     "in q 1\n# one\nx1 = sin(q0)\n# three\nx2 = sqrt(q0)\nout y 2: x1 x2\n"},
    // Nothing but inputs.
    {"in q 2\nx2 = q0 * q1\nout y 2: -q1 q0\n", "in q 2\nout y 2: -q1 q0\n"},
};
INSTANTIATE_TEST_SUITE_P(Cases, RemoveDead, testing::ValuesIn(kCases),
                         [](const auto& at) { return "case" + std::to_string(at.index + 1); });

TEST(RunPasses, LeavesAVerifiedGraphWithoutAdditions) {
  const Graph graph = run_passes(parse(
      "region f\nin q 2\nx2 = q0 * q1\nx3 = x2 + q0\nx4 = q1 * q1\nx5 = x4 * q0\nout y 1: x3\n"));
  EXPECT_EQ(print(graph), "region f\nin q 2\nx2 = sum(q0, q0*q1)\nout y 1: x2\n");
}

TEST(RunPasses, VerifiesWhatItIsGiven) {
  Graph graph = parse("region f\nin q 2\nx2 = q0 * q1\nout y 1: x2\n");
  graph.regions[0].nodes[2].block = 5;
  EXPECT_THROW(run_passes(graph), std::logic_error);
}

}  // namespace
}  // namespace arboc::test

// schedule(): what goes into the prologue, the angles, the chunks and the slots, in printed form.
#include <gtest/gtest.h>

#include <stdexcept>

#include "program/program.h"
#include "support/interpreter.h"

namespace arboc::test {
namespace {

Graph region(const std::string& lines) { return parse("region f\n" + lines); }

TEST(Schedule, SinesOfInputsComeFirst) {
  const Program program =
      schedule(region("in q 2\n# one\nx2 = sin(q0)\nx3 = cos(q0)\nx4 = sin(q1)\nx5 = x2 * x4\n"
                      "x6 = sum(x5, x3*q1)\nout y 2: x6 -x4\n"));
  EXPECT_EQ(print(program),
            "program f: 8 slots, 2 operations, 2 sincos\n"
            "w[0], w[4] = sincos(q[0])\n"
            "w[1], w[5] = sincos(q[1])\n"
            "chunk 0\n"
            "# one\n"
            "x5 = w[0] * w[1]\n"
            "x6 = x5 + w[4] * q[1]\n"
            "y[0] = x6\n"
            "y[1] = -w[1]\n");
}

TEST(Schedule, AnglesMayNeedAPrologue) {
  // The angle's own parts are also stored and used later: they get slots.
  const Program program =
      schedule(region("in q 2\nx2 = 2 * q0\nx3 = sum(q1, -x2)\nx4 = cos(x3)\nx5 = x4 * x2\n"
                      "out y 2: x5 -x3\n"));
  EXPECT_EQ(print(program),
            "program f: 3 slots, 3 operations, 1 sincos\n"
            "x3 = T(2.0) * q[0]\n"
            "w[2] = x3\n"
            "x4 = q[1] - x3\n"
            "y[1] = -x4\n"
            "w[0], w[1] = sincos(x4)\n"
            "chunk 0\n"
            "x6 = w[2] * w[1]\n"
            "y[0] = x6\n");
}

TEST(Schedule, SineOfASine) {
  const Graph graph =
      region("in q 1\nx1 = sin(q0)\nx2 = 3 * x1\nx3 = sin(x2)\nx4 = cos(x3)\nout y 2: x3 -x4\n");
  const Program program = schedule(graph);
  EXPECT_EQ(print(program),
            "program f: 2 slots, 1 operations, 3 sincos\n"
            "w[0], w[1] = sincos(q[0])\n"
            "chunk 0\n"
            "x3 = T(3.0) * w[0]\n"
            "x4 = sin(x3)\n"
            "y[0] = x4\n"
            "x5 = cos(x4)\n"
            "y[1] = -x5\n");
  EXPECT_EQ(interpret(program, {{0.7}}), evaluate(graph, {{0.7}}));
}

TEST(Schedule, ChunksPassValuesThroughSlots) {
  const Graph graph = region(
      "in q 2\nx2 = q0 * q0\nx3 = q1 * q1\nx4 = x2 * q1\nx5 = x3 * x4\nx6 = x5 * q0\n"
      "x7 = x6 * x5\nx8 = x7 * q0\nx9 = x8 + x7\nout y 1: x9\n");
  const Program program = schedule(graph, {.chunk_ops = 2});
  EXPECT_EQ(print(program),
            "program f: 3 slots, 8 operations, 0 sincos\n"
            "chunk 0\n"
            "x2 = q[0] * q[0]\n"
            "w[0] = x2\n"
            "x3 = q[1] * q[1]\n"
            "w[1] = x3\n"
            "chunk 1\n"
            "x4 = q[1] * w[0]\n"
            "x5 = w[1] * x4\n"
            "w[2] = x5\n"
            "chunk 2\n"
            "x6 = q[0] * w[2]\n"
            "x7 = w[2] * x6\n"
            "w[1] = x7\n"  // again: its first value was last read in chunk 1
            "chunk 3\n"
            "x8 = q[0] * w[1]\n"
            "x9 = w[1] + x8\n"
            "y[0] = x9\n");
}

TEST(Schedule, OutputsThatAreNoStatements) {
  EXPECT_EQ(print(schedule(region("in q 2\nx2 = cos(q1)\nout y 4: -q1 0.5 -2 x2\n"))),
            "program f: 2 slots, 0 operations, 1 sincos\n"
            "w[0], w[1] = sincos(q[1])\n"
            "chunk 0\n"
            "y[0] = -q[1]\n"
            "y[1] = T(0.5)\n"
            "y[2] = -T(2.0)\n"
            "y[3] = w[1]\n");
}

TEST(Schedule, SeveralPorts) {
  EXPECT_EQ(print(schedule(region("in q 2\nin none 0\nin v 2\nx4 = q1 / v1\nx5 = sqrt(x4)\n"
                                  "out y 1: x5\nout z 2: x5 -v0\n"))),
            "program f: 0 slots, 2 operations, 0 sincos\n"
            "chunk 0\n"
            "x4 = q[1] / v[1]\n"
            "x5 = sqrt(x4)\n"
            "y[0] = x5\n"
            "z[0] = x5\n"
            "z[1] = -v[0]\n");
}

TEST(CountOps, Sums) {
  const auto count = [](const std::string& sum) {
    return schedule(region("in q 6\nx6 = sum(" + sum + ")\nout y 1: x6\n")).ops;
  };
  struct {
    const char* sum;
    int mul, add, fma;
  } const cases[] = {
      {"q0, q1", 0, 1, 0},          {"q0, q1, -q2", 0, 2, 0},         {"q0, q1*q2", 0, 0, 1},
      {"q0, q1, q2*q3", 0, 1, 1},   {"q0*q1, q2*q3", 1, 0, 1},        {"q0*q1, -q2", 0, 0, 1},
      {"q0*q1, -q2, -q3", 0, 1, 1}, {"q0*q1, q2*q3, q4*q5", 1, 0, 2},
  };
  for (const auto& c : cases) {
    const OpCount ops = count(c.sum);
    EXPECT_EQ(ops.mul, c.mul) << c.sum;
    EXPECT_EQ(ops.add, c.add) << c.sum;
    EXPECT_EQ(ops.fma, c.fma) << c.sum;
    EXPECT_EQ(ops.total(), c.mul + c.add + c.fma) << c.sum;
  }
}

// The interpreter is the judge of random programs: it must see what is wrong.
TEST(Interpreter, SeesBrokenPrograms) {
  const Graph graph = region("in q 1\nx1 = q0 * q0\nx2 = x1 * q0\nx3 = x2 * x1\nout y 1: x3\n");
  const auto broken = [&](auto breaks) {
    Program program = schedule(graph, {.chunk_ops = 1});
    breaks(program);
    EXPECT_THROW(interpret(program, {{2.0}}), std::exception);
  };
  broken([](Program& p) { p.chunks[0].statements[0].slot = -1; });
  broken([](Program& p) { p.chunks[1].statements[0].terms[0].b.place = Operand::Place::kLocal; });
  broken([](Program& p) { p.chunks.back().statements.back().stores.clear(); });
  broken([](Program& p) { p.chunks.pop_back(); });
  broken([](Program& p) { p.stores.push_back(p.chunks.back().statements.back().stores[0]); });
  EXPECT_EQ(interpret(schedule(graph), {{2.0}})[0][0], 32);
}

}  // namespace
}  // namespace arboc::test

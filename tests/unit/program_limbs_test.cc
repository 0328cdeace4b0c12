// Programs limb by limb: order, and the text of what limbs share.
#include <gtest/gtest.h>

#include "program/program.h"
#include "support/interpreter.h"

namespace arboc::test {
namespace {

std::string printed(const std::string& lines, int chunk_ops = 250) {
  const Graph graph = parse("region f\n" + lines);
  const Program program = schedule(graph, {chunk_ops, true});
  std::vector<std::vector<double>> inputs;
  for (const Port& port : graph.regions[0].inputs)
    for (inputs.emplace_back(); static_cast<int>(inputs.back().size()) < port.size;)
      inputs.back().push_back(0.3 + static_cast<double>(inputs.back().size()));
  EXPECT_EQ(interpret(program, inputs), evaluate(graph, inputs));
  return print(program);
}

TEST(LimbByLimb, ScalarsLimbsAndScalarsAgain) {
  // Numbers that differ and the entries of each limb stand in its row; what only sines need of a
  // pack is not gathered.
  EXPECT_EQ(
      printed("in q 3\nin v 3\nx6 = pack(q1, q2)\nx7 = pack(v1, v2)\nx8 = sin(x6)\n"
              "x9 = v0 * v0\nx10 = sum(x9, [0.5|-2]*x8, x7*x7)\nx11 = hsum2(x10)\n"
              "x12 = x11 * q0\nx13 = lane0(x10)\nx14 = lane1(x10)\n"
              "out y 3: x12 -x13 -x14\n"),
      "program f: 9 slots, 7 operations, 2 sincos\n"
      "w[0], w[4] = sincos(q[1])\n"
      "w[1], w[5] = sincos(q[2])\n"
      "chunk 0\n"
      "x9 = v[0] * v[0]\n"
      "w[8] = x9\n"
      "chunk 1, for each of 2 limbs\n"
      "template <class T>\nstatic constexpr arboc::real_t<T> part1_number[2][1] = {{0.5}, {-2}}\n"
      "template <class T>\nstatic constexpr unsigned short part1_entry[2][1] = {{1}, {2}}\n"
      "const arboc::real_t<T>* const number = part1_number<T>[limb]\n"
      "const unsigned short* const entry = part1_entry<T>[limb]\n"
      "T* const own = w2 + 1 * limb\n"
      "x7 = v[entry[0]]\n"
      "x11 = w[8] + T(number[0]) * w[limb] + x7 * x7\n"
      "own[0] = x11\n"
      "y[entry[0]] = -x11\n"
      "chunk 2\n"
      "x12 = w2[0] + w2[1]\n"
      "x13 = q[0] * x12\n"
      "y[0] = x13\n");
}

TEST(LimbByLimb, AnEntryThatOnlySomeLimbsHave) {
  const std::string text = printed(
      "in q 3\nx3 = pack(q0, q1, q2, q2)\nx4 = x3 * x3\nx5 = lane0(x4)\nx6 = lane2(x4)\n"
      "x7 = hsum3(x4)\nout y 3: x7 x5 x6\n");
  EXPECT_NE(text.find("chunk 0, for each of 3 limbs\n"), std::string::npos) << text;
  EXPECT_NE(text.find("if (limb == 0) y[1] = x4\nif (limb == 2) y[2] = x4\n"), std::string::npos)
      << text;
}

TEST(LimbByLimb, WhatIsNotGatheredFromOneInputIsLaidOutByTheScalars) {
  const std::string text = printed(
      "in q 2\nx2 = q0 * q1\nx3 = pack(x2, -q1)\nx4 = x3 * x3\nx5 = lane0(x4)\n"
      "x6 = lane1(x4)\nout y 2: x5 x6\n");
  EXPECT_NE(text.find("w2[0] = x2\nw2[1] = -q[1]\nchunk 1, for each of 2 limbs\n"),
            std::string::npos)
      << text;
}

TEST(LimbByLimb, OneLimbReadsAnotherOneOnlyWhenThatIsDone) {
  const std::string text = printed(
      "in q 2\nx2 = pack(q0, q1)\nx3 = x2 * x2\nx4 = lane1(x3)\nx5 = x2 * x4\n"
      "x6 = lane0(x5)\nx7 = lane1(x5)\nout y 2: x6 x7\n");
  EXPECT_NE(text.find("chunk 1, for each of 2 limbs\n"), std::string::npos) << text;
}

TEST(LimbByLimb, ChunksAreCutWithinAPhase) {
  const std::string text = printed(
      "in q 2\nx2 = pack(q0, q1)\nx3 = x2 * x2\nx4 = x3 * x2\nx5 = x4 * x3\n"
      "x6 = x5 * x4\nx7 = hsum2(x6)\nout y 1: x7\n",
      2);
  EXPECT_NE(text.find("chunk 2, for each of 2 limbs\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace arboc::test

// Lanes in a graph: the rules of Builder, the printed form, what verify() refuses, and fusing.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "graph/builder.h"
#include "passes/passes.h"
#include "program/program.h"

namespace arboc::test {
namespace {

struct Case {
  const char* before;
  const char* after;
};

/// Of inputs q (4) and v (2); the last line says what is kept of `y`.
class LaneRules : public testing::TestWithParam<Case> {};

TEST_P(LaneRules, Rewrite) {
  const std::string head = "region f\nin q 4\nin v 2\n";
  const Graph graph = parse(head + GetParam().before);
  verify(graph);
  const std::string text = print(run_passes(graph, {.fuse = false}));
  EXPECT_EQ(text, head + GetParam().after) << GetParam().before;
  EXPECT_EQ(print(parse(text)), text);
}

const Case kLaneRules[] = {
    // Packs.
    {"x = pack(q0, q0)\ny = lane1(x)\nout y 1: y\n", "out y 1: q0\n"},
    {"x = pack(q0, q1)\ny = lane1(x)\nout y 1: -y\n", "out y 1: -q1\n"},
    {"x = pack(1, -2)\ny = x * v0\nz = lane1(y)\nout y 1: z\n",
     "x7 = [1|-2] * v0\nx8 = lane1(x7)\nout y 1: x8\n"},
    {"x = pack(2, 2)\ny = x * v0\nout y 1: y\n", "x7 = 2 * v0\nout y 1: x7\n"},
    // Constants fold lane by lane; zeros and ones where all lanes agree.
    {"x = [1|2] + [2|1]\ny = x * v0\nout y 1: y\n", "x7 = 3 * v0\nout y 1: x7\n"},
    {"x = [1|2] * [0|1]\ny = x * v0\nz = hsum2(y)\nout y 1: z\n",
     "x7 = [0|2] * v0\nx8 = hsum2(x7)\nout y 1: x8\n"},
    {"x = [2|4] * v0\ny = [0.5|0.25] * x\nout y 1: y\n", "out y 1: v0\n"},
    {"x = [2|4] * v0\ny = x / [2|4]\nout y 1: y\n", "out y 1: v0\n"},
    {"p = pack(q0, q1)\nx = [-1|1] * p\ny = hsum2(x)\nout y 1: y\n",
     "x6 = pack(q0, q1)\nx8 = [1|-1] * x6\nx9 = hsum2(x8)\nout y 1: -x9\n"},
    {"p = pack(q0, q1)\nx = p + [1|-1]\ny = x + [-1|1]\nz = lane0(y)\nout y 1: z\n",
     "out y 1: q0\n"},
    // Sums over lanes.
    {"y = hsum3(v0)\nout y 1: y\n", "x7 = 3 * v0\nout y 1: x7\n"},
    {"x = [1|2|3|4] * [2|2|2|1]\ny = hsum4(x)\nz = hsum3(x)\nout y 2: y z\n", "out y 2: 16 12\n"},
    {"p = pack(q0, q1)\nr = pack(q2, q3)\nx = hsum2(p)\ny = hsum2(r)\nz = x + -y\nout y 1: z\n",
     "x6 = pack(q0, q1)\nx7 = pack(q2, q3)\nx8 = x6 + -x7\nx9 = hsum2(x8)\nout y 1: x9\n"},
    {"p = pack(q0, q1)\nr = pack(q2, q3)\nx = hsum2(p)\ny = hsum2(r)\nu = v0 + x\nz = u + y\nout y "
     "1: "
     "z\n",
     "x6 = pack(q0, q1)\nx7 = pack(q2, q3)\nx8 = x6 + x7\nx9 = hsum2(x8)\nx10 = v0 + x9\n"
     "out y 1: x10\n"},
};
INSTANTIATE_TEST_SUITE_P(Table, LaneRules, testing::ValuesIn(kLaneRules));

std::string renumbered(std::string text) { return text.substr(text.find("in v 2\n") + 7); }

// A product of scalars stays one where it meets lanes: it is broadcast once.
TEST(FuseLanes, ScalarsDoNotJoinSumsInLanes) {
  const Graph graph = run_passes(
      parse("region f\nin q 4\nin v 2\nx = v0 * v1\np = pack(q0, q1)\ny = p * p\nz = y + x\n"
            "a = v0 + v1\nb = z + a\nc = hsum2(b)\nout y 1: c\n"));
  EXPECT_EQ(renumbered(print(graph)),
            "x6 = v0 * v1\nx7 = pack(q0, q1)\nx8 = sum(v0, v1)\nx9 = sum(x6, x8, x7*x7)\n"
            "x10 = hsum2(x9)\nout y 1: x10\n");
}

TEST(FuseLanes, NegatedStoresNegateTheVector) {
  const Graph graph = run_passes(
      parse("region f\nin q 4\nin v 2\np = pack(q0, q1)\nx = v0 * p\ny = x + v1\nk = lane0(y)\n"
            "l = lane1(y)\nout y 2: -k -l\n"));
  EXPECT_EQ(renumbered(print(graph)),
            "x6 = pack(q0, q1)\nx7 = sum(-v1, -v0*x6)\nx8 = lane0(x7)\nx9 = lane1(x7)\n"
            "out y 2: x8 x9\n");
}

Graph good() {
  return parse(
      "region f\nin q 4\nx = pack(q0, q1)\ny = [0.5|-2] * x\nz = hsum2(y)\nl = lane1(y)\n"
      "out y 2: z l\n");
}

struct Broken {
  const char* message;
  std::function<void(Region&)> breaks;
};

TEST(VerifyLanes, NamesEachBrokenInvariant) {
  const Broken cases[] = {
      {"region f, node 4: pack of lanes",
       [](Region& r) {
         r.nodes[3].width = 1;  // an input that is made a constant in lanes
         r.nodes[3].op = Op::kConstant;
         r.nodes[3].index = 0;
         r.nodes[3].count = 2;
         r.nodes[3].width = 2;
         r.terms[0].a = Ref(3);
       }},
      {"region f, node 6: wrong width", [](Region& r) { r.nodes[6].width = 1; }},
      {"region f, node 7: unknown lane", [](Region& r) { r.nodes[7].index = 3; }},
      {"region f, node 8: unknown lane", [](Region& r) { r.nodes[8].index = 2; }},
      {"region f, node 8: unknown lane", [](Region& r) { r.nodes[8].a = Ref(0); }},
      {"region f, node 5: lanes of a constant all the same",
       [](Region& r) { r.constants[1] = r.constants[0]; }},
      {"region f, node 5: constant not finite and non-negative",
       [](Region& r) { r.constants[0] = -1; }},
      {"region f: result in lanes", [](Region& r) { r.results[0][0] = Ref(6); }},
  };
  EXPECT_NO_THROW(verify(good()));
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
}

TEST(BuilderLanes, RefusesOperandsOfDifferentWidths) {
  EXPECT_THROW(parse("in q 4\nx = pack(q0, q1)\ny = pack(q0, q1, q2, q3)\nz = x + y\n"),
               std::invalid_argument);
}

TEST(EvaluateLanes, EachOperation) {
  const Graph graph = parse(
      "region f\nin q 4\nin v 2\nx = pack(q0, q1, q2, q3)\ny = x * v0\nz = [1|2|3|4] + y\n"
      "s = sum(z, -x*y)\na = lane2(s)\nb = hsum4(s)\nc = hsum3(z)\nd = sin(x)\ne = lane3(d)\n"
      "out y 4: a b c e\n");
  const double q[] = {0.5, -1, 2, 0.25}, v = 3;
  double s[4], z[4];
  for (int k = 0; k < 4; ++k) {
    z[k] = k + 1 + q[k] * v;
    s[k] = z[k] - q[k] * (q[k] * v);
  }
  EXPECT_EQ(evaluate(graph, {{0.5, -1, 2, 0.25}, {v, 7}})[0],
            (std::vector<double>{s[2], (s[0] + s[2]) + (s[1] + s[3]), z[0] + z[1] + z[2],
                                 std::sin(0.25)}));
}

// Sines of packs are taken of their entries, wide ones first.
TEST(ScheduleLanes, SinesOfPacksLieSideBySide) {
  const Program program = schedule(run_passes(parse(
      "region f\nin q 4\nin v 2\ns = sin(v0)\np = pack(q0, q1, q2, q3)\na = cos(p)\nb = v1 * a\n"
      "c = hsum4(b)\nd = c * s\ne = lane2(b)\nout y 2: d -e\n")));
  EXPECT_EQ(print(program),
            "program f: 16 slots, 2 operations, 5 sincos\n"
            "w[0], w[8] = sincos(q[0])\n"
            "w[1], w[9] = sincos(q[1])\n"
            "w[2], w[10] = sincos(q[2])\n"
            "w[3], w[11] = sincos(q[3])\n"
            "w[4], w[12] = sincos(v[0])\n"
            "chunk 0\n"
            "x9 = v[1] * arboc::lanes<4>(w + 8)\n"
            "y[1] = -x9[2]\n"
            "x10 = arboc::hsum<4>(x9)\n"
            "x11 = w[4] * x10\n"
            "y[0] = x11\n");
  EXPECT_EQ(program.ops.hsum, 1);
  EXPECT_EQ(program.ops.lane, 1);
  EXPECT_EQ(program.ops.pack, 0);
}

}  // namespace
}  // namespace arboc::test

// The functions of rotations: the runtime against long double, and as operations of the graph.
#include <gtest/gtest.h>

#include <cmath>

#include "arboc/scalar.hpp"
#include "graph/expr.h"
#include "passes/passes.h"
#include "program/program.h"
#include "support/interpreter.h"
#include "support/random.h"

namespace arboc::test {
namespace {

// A few units of the last place; the recursions of c_5 and above amplify them by up to 3 a step.
constexpr double kUnit = 0x1p-53;
constexpr double kUlps = 24;

/// c_k by its series where that does not cancel, otherwise by the closed forms.
long double exact_stumpff(int k, long double x) {
  if (x < 9) {
    long double term = 1, sum = 0;
    for (int i = 1; i <= k; ++i) term /= i;
    for (int i = 0; i < 40; ++i) {
      sum += term;
      term *= -x / ((k + 2 * i + 1) * (k + 2 * i + 2));
    }
    return sum;
  }
  const long double t = std::sqrt(x);
  if (k == 0) return std::cos(t);
  if (k == 1) return std::sin(t) / t;
  long double constant = 1;
  for (int i = 1; i <= k - 2; ++i) constant /= i;
  return (constant - exact_stumpff(k - 2, x)) / x;
}

template <int k>
void expect_stumpff(double x) {
  const long double exact = exact_stumpff(k, x);
  // Beyond the first zero what counts is the size of the oscillation.
  const long double scale =
      std::max(std::fabs(exact), k < 3 ? std::pow(1 + std::sqrt(x), -1.0L * k) : 0.0L);
  EXPECT_LE(std::fabs(stumpff<k>(x) - exact) / scale, kUlps * kUnit) << "c_" << k << " of " << x;
}

void expect_all_stumpff(double x) {
  expect_stumpff<0>(x);
  expect_stumpff<1>(x);
  expect_stumpff<2>(x);
  expect_stumpff<3>(x);
  expect_stumpff<4>(x);
  expect_stumpff<5>(x);
  expect_stumpff<6>(x);
  expect_stumpff<7>(x);
}

TEST(SpecialFunctions, StumpffIsAccurate) {
  expect_all_stumpff(0);
  Random random(1);
  for (const double range : {1e-6, 1e-2, 1.0, 10.0, 40.0, 1000.0})
    for (int n = 0; n < 2000; ++n) expect_all_stumpff(random.uniform(0, range));
}

TEST(SpecialFunctions, LogarithmIsAccurate) {
  Random random(2);
  const auto check = [](double w) {
    const long double c = std::fabs(w), h = std::acos(c), s = std::sqrt((1 - c) * (1 + c));
    const long double ratio = c == 1 ? 1 : h / s;
    const long double b =
        c > 0.9999L ? (1 + (2 * h) * (2 * h) / 60) / 12 : (1 - c * ratio) / (4 * h * h);
    EXPECT_LE(std::fabs(quaternion_log(w) - (w < 0 ? -2 : 2) * ratio), kUlps * kUnit * ratio) << w;
    EXPECT_LE(std::fabs(log_curvature(w) - b), (c > 0.9999L ? 1e-9L : kUlps * kUnit) * b) << w;
  };
  for (int n = 0; n < 20000; ++n) check(random.uniform(-1, 1));
  for (int e = -50; e < -1; ++e) check(1 - std::ldexp(1.0, e));
  for (const double w : {-1.0, 0.0, 1.0, 0.98, -0.98}) check(w);
  EXPECT_NEAR(quaternion_log(1 + 4 * kUnit), 2, 1e-14);
  EXPECT_NEAR(log_curvature(1 + 4 * kUnit), 1.0 / 12, 1e-15);
}

TEST(SpecialFunctions, ServeOtherScalars) {
  EXPECT_NEAR(stumpff<3>(2.0f), stumpff<3>(2.0), 1e-7);
  EXPECT_NEAR(quaternion_log(0.5f), quaternion_log(0.5), 1e-6);
  EXPECT_NEAR(log_curvature(-0.5f), log_curvature(-0.5), 1e-8);
}

constexpr const char* kText =
    "region special\n"
    "in q 2\n"
    "x2 = stumpff3(q0)\n"
    "x3 = quaternion_log(q1)\n"
    "x4 = log_curvature(q1)\n"
    "x5 = x2 + x3\n"
    "out y 3: x5 -x3 x4\n";

TEST(SpecialFunctions, ArePrintedReadAndEvaluated) {
  const Graph graph = parse(kText);
  verify(graph);
  EXPECT_EQ(print(graph), kText);
  const std::vector<std::vector<double>> in = {{2, -0.25}};
  const auto y = evaluate(graph, in)[0];
  EXPECT_EQ(y[1], -quaternion_log(-0.25));
  EXPECT_EQ(y[2], log_curvature(-0.25));
  const Program program = schedule(run_passes(graph));
  EXPECT_EQ(program.ops.special, 3);
  EXPECT_EQ(interpret(program, in)[0], y);
  EXPECT_NE(print(program).find("= arboc::stumpff<3>(q[0])"), std::string::npos);
  EXPECT_THROW(parse("in q 1\nx1 = stumpff77(q0)\nout y 1: x1\n"), std::invalid_argument);
}

TEST(SpecialFunctions, FoldAndShare) {
  Builder builder("f");
  const Ref w = builder.input("w", 1)[0];
  EXPECT_EQ(builder.quaternion_log(-w), -builder.quaternion_log(w));
  EXPECT_EQ(builder.log_curvature(-w), builder.log_curvature(w));
  EXPECT_NE(builder.stumpff(2, w).node(), builder.stumpff(3, w).node());
  EXPECT_EQ(builder.region().value(builder.stumpff(3, builder.constant(0))), 1.0 / 6);
  EXPECT_EQ(builder.region().value(builder.quaternion_log(builder.constant(-1))), -2.0);
  EXPECT_EQ(stumpff<0>(Expr(0.0)).value(), 1);
}

}  // namespace
}  // namespace arboc::test

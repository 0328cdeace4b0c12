// Expr: an algorithm run with it records what it computes, and constants stay outside the graph.
#include "graph/expr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/exact_trig.h"

namespace arboc::test {
namespace {

class ExprTrace : public testing::Test {
 protected:
  ExprTrace() : builder_("f") {
    for (const Ref ref : builder_.input("q", 3)) q_.emplace_back(&builder_, ref);
  }
  /// The printed lines that `result` depends on, after "in".
  std::string traced(const Expr& result) {
    builder_.output("y", {result.ref(builder_)});
    const std::string text = print(std::move(builder_).finish());
    return text.substr(text.find("in q 3\n") + 7);
  }

  Builder builder_;
  std::vector<Expr> q_;
};

TEST_F(ExprTrace, Operators) {
  const Expr twice = 2.0 * q_[0];  // operands of one expression may be traced in any order
  Expr y = twice - q_[1] / q_[2];
  y += q_[1];
  y -= 1.0;
  y *= -q_[0];
  EXPECT_EQ(traced(y),
            "x4 = 2 * q0\n"
            "x5 = q1 / q2\n"
            "x6 = x4 + -x5\n"
            "x7 = q1 + x6\n"
            "x9 = x7 + -1\n"
            "x10 = q0 * x9\n"
            "out y 1: -x10\n");
}

TEST_F(ExprTrace, Functions) {
  Expr s, c;
  sincos(q_[0] - q_[1], s, c);
  const Expr ss = s * s;
  EXPECT_EQ(traced(sqrt(ss + c * c)),
            "x3 = q0 + -q1\n"
            "x4 = sin(x3)\n"
            "x5 = cos(x3)\n"
            "x6 = x4 * x4\n"
            "x7 = x5 * x5\n"
            "x8 = x6 + x7\n"
            "x9 = sqrt(x8)\n"
            "out y 1: x9\n");
}

TEST_F(ExprTrace, ConstantsMakeNoNodes) {
  Expr s, c;
  sincos(Expr(degrees15(6)), s, c);
  EXPECT_EQ(s.value(), 1);
  EXPECT_EQ(c.value(), 0);
  const Expr five = Expr(2.0) * 3.0 - sqrt(Expr(4.0)) / 2.0;
  EXPECT_TRUE(five.is_constant());
  EXPECT_EQ(five.value(), 5);
  EXPECT_FALSE(std::signbit((-Expr(0.0)).value()));
  EXPECT_EQ(builder_.region().nodes.size(), 3u);
}

TEST_F(ExprTrace, ConstantSinesAreThoseOfExactTrig) {
  for (const double angle : {0.3, -2.0, 1e6, 123.456}) {
    Expr s, c;
    sincos(Expr(angle), s, c);
    EXPECT_EQ(s.value(), exact_sincos(angle).sin) << angle;
    EXPECT_EQ(c.value(), exact_sincos(angle).cos) << angle;
  }
}

/// More angles than are remembered, in two orders: each has its own sine whatever was asked before.
TEST(ExactSincos, DoesNotDependOnWhatWasAskedBefore) {
  std::vector<SinCos> first;
  for (int k = -5000; k <= 5000; ++k) first.push_back(exact_sincos(k * 1e-3));
  for (int k = 5000; k >= -5000; --k) {
    const double angle = k * 1e-3;
    const SinCos at = exact_sincos(angle), before = first[static_cast<size_t>(k + 5000)];
    EXPECT_EQ(at.sin, before.sin);
    EXPECT_EQ(at.cos, before.cos);
    EXPECT_NEAR(at.sin, std::sin(angle), 2e-16);
    EXPECT_NEAR(at.cos, std::cos(angle), 2e-16);
    EXPECT_EQ(exact_sincos(angle).sin, at.sin);
  }
  EXPECT_EQ(exact_sincos(0).cos, 1);
}

TEST_F(ExprTrace, WhatFoldsToAConstantLeavesTheGraph) {
  const Expr zero = q_[0] - q_[0];
  EXPECT_TRUE(zero.is_constant());
  EXPECT_TRUE(is_zero(zero));
  EXPECT_TRUE(is_zero(q_[1] * zero));
  EXPECT_TRUE((zero + 2.0).is_constant());
  EXPECT_FALSE(is_zero(q_[0]));
  EXPECT_FALSE(is_zero(Expr(1e-300)));
}

TEST_F(ExprTrace, Blocks) {
  enter_block(q_.data(), "link 1: arm", "forward");
  EXPECT_EQ(traced(q_[0] + q_[1]),
            "# link 1: arm, forward\n"
            "x3 = q0 + q1\n"
            "out y 1: x3\n");
}

}  // namespace
}  // namespace arboc::test

// fuse(): one table a rule.  `a * b` inside sum() is fused; `(a * b)` is computed by itself.
#include "passes/fuse.h"

#include <gtest/gtest.h>

#include "passes/dead.h"
#include "support/expression.h"

namespace arboc::test {
namespace {

struct Case {
  const char* before;
  const char* after;
};

class Fuse : public testing::TestWithParam<Case> {};

TEST_P(Fuse, Table) {
  const Graph after = remove_dead(fuse(graph_of(GetParam().before)));
  verify(after);
  EXPECT_EQ(expressions_of(after), GetParam().after) << GetParam().before;
}

/// Additions with one user join it; others are computed once.
const Case kRoots[] = {
    {"a + b", "sum(a, b)"},
    {"a + b + c + d", "sum(d, c, a, b)"},
    {"(a + b) - (c - d)", "sum(a, b, -c, d)"},
    {"(a + b) * c", "c * sum(a, b)"},
    {"a + b; a + b + c", "sum(a, b); sum(c, sum(a, b))"},
    {"sin(a + b) + (a + b)", "sum(sum(a, b), sin(sum(a, b)))"},
    {"a + 2 + b", "sum(2, b, a)"},
    {"sqrt(a)", "sqrt(a)"},
    {"a; -b; 3", "a; -b; 3"},
};

/// Products that only sums use move into them, in front of none of the atoms.
const Case kProducts[] = {
    {"a * b + c", "sum(c, a * b)"},
    {"a * b + c * d", "sum(a * b, c * d)"},
    {"a * b + c * d + e", "sum(e, a * b, c * d)"},
    {"a * b - c * d - e", "sum(a * b, -e, -c * d)"},
    {"2 * a + b", "sum(b, 2 * a)"},
    {"a * b * c + d", "sum(d, c * (a * b))"},
    {"(a + b) * c + d", "sum(d, c * sum(a, b))"},
    {"a * b + c; a * b", "sum(c, (a * b)); a * b"},
    {"a * b + c; sin(a * b)", "sum(c, (a * b)); sin(a * b)"},
    {"a / b + c", "sum(c, (a / b))"},
};

/// A product that several sums use moves into all of them.
const Case kShared[] = {
    {"a * b + c; a * b + d", "sum(c, a * b); sum(d, a * b)"},
    {"a * b + c; a * b - d; a * b + e * f", "sum(c, a * b); sum(a * b, -d); sum(a * b, e * f)"},
};

/// A sum of nothing but shared products starts with one that is computed by itself.
const Case kStarters[] = {
    {"a * b + c * d; a * b - c * d", "sum((a * b), c * d); sum((a * b), -c * d)"},
    {"a * b + c * d; a * b + e * f; c * d + e * f",
     "sum((a * b), (c * d)); sum((a * b), e * f); sum((c * d), e * f)"},
    {"c * d - a * b; a * b + e; c * d + f", "sum((c * d), -a * b); sum(e, a * b); sum(f, (c * d))"},
};

/// The first term is positive, unless all are negative because outputs want the negative.
const Case kSigns[] = {
    {"c - a * b", "sum(c, -a * b)"},
    {"a * b - c", "sum(a * b, -c)"},
    {"-a - b", "sum(-a, -b)"},
    {"-(a - b)", "sum(b, -a)"},
    {"-(a * b) - c * d", "sum(-a * b, -c * d)"},
    {"b - a; -(b - a)", "-sum(a, -b); sum(a, -b)"},
    {"-(a - b); sin(a - b)", "sum(b, -a); -sin(sum(b, -a))"},
    {"sin(-a - b)", "-sin(sum(a, b))"},
    {"sin(a - b)", "sin(sum(a, -b))"},
    {"-(a + b); (a + b) * c", "sum(-a, -b); -(c * sum(-a, -b))"},
};

/// Deep operands last: they are ready last.
const Case kOrder[] = {
    {"sin(sin(a)) + sin(b) + c", "sum(c, sin(b), sin(sin(a)))"},
    {"sin(a) * b + c * d + e", "sum(e, c * d, b * sin(a))"},
};

INSTANTIATE_TEST_SUITE_P(Roots, Fuse, testing::ValuesIn(kRoots));
INSTANTIATE_TEST_SUITE_P(Products, Fuse, testing::ValuesIn(kProducts));
INSTANTIATE_TEST_SUITE_P(Shared, Fuse, testing::ValuesIn(kShared));
INSTANTIATE_TEST_SUITE_P(Starters, Fuse, testing::ValuesIn(kStarters));
INSTANTIATE_TEST_SUITE_P(Signs, Fuse, testing::ValuesIn(kSigns));
INSTANTIATE_TEST_SUITE_P(Order, Fuse, testing::ValuesIn(kOrder));

TEST(FuseText, KeepsPortsAndTitles) {
  const Graph after =
      remove_dead(fuse(parse("region f\nin q 2\nin v 1\n# one\nx3 = q0 * v0\n"
                             "# two\nx4 = x3 + q1\nout y 1: x4\nout z 1: -q0\n")));
  EXPECT_EQ(print(after),
            "region f\nin q 2\nin v 1\n# two\nx3 = sum(q1, q0*v0)\nout y 1: x3\nout z 1: -q0\n");
}

TEST(FuseText, RefusesItsOwnOutput) {
  EXPECT_THROW(fuse(fuse(graph_of("a + b"))), std::logic_error);
}

}  // namespace
}  // namespace arboc::test

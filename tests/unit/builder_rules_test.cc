// The rewriting rules of Builder, one line each: what is asked for and what is kept.
#include <gtest/gtest.h>

#include "graph/builder.h"
#include "support/expression.h"

namespace arboc::test {
namespace {

struct Rule {
  const char* before;
  const char* after;
};

class BuilderRules : public testing::TestWithParam<Rule> {};

TEST_P(BuilderRules, Rewrite) {
  const Graph graph = graph_of(GetParam().before);
  verify(graph);
  EXPECT_EQ(expressions_of(graph), GetParam().after) << GetParam().before;
}

const Rule kSums[] = {
    {"a + 0", "a"},
    {"0 + a", "a"},
    {"a - 0", "a"},
    {"0 - a", "-a"},
    {"2 + 3", "5"},
    {"2 - 3", "-1"},
    {"2 - 2", "0"},
    {"a - a", "0"},
    {"-a + a", "0"},
    {"a + a", "2 * a"},
    {"-a - a", "-(2 * a)"},
    {"2 * a + 3 * a", "5 * a"},
    {"2 * a - 3 * a", "-a"},
    {"2 * a + a", "3 * a"},
    {"a - 0.5 * a", "0.5 * a"},
    {"2 * a - 2 * a", "0"},
    {"a + b", "a + b"},
    {"b + a", "a + b"},
    {"b - a", "-(a - b)"},
    {"-a - b", "-(a + b)"},
    {"-a + b", "-(a - b)"},
    {"(a + b) - b", "a"},
    {"(a + b) - a", "b"},
    {"(a - b) + b", "a"},
    {"(a - b) - a", "-b"},
    {"b - (a + b)", "-a"},
    {"-(a + b) + a", "-b"},
    {"(a + b) - a - b", "0"},
    {"1 + (2 + a)", "a + 3"},
    {"(a - 1) + 1", "a"},
    {"1 - (2 - a)", "a - 1"},
    {"(2 + a) - 5", "a - 3"},
    {"(a + b) + b", "b + (a + b)"},
    {"a * b + a * c", "(a * b) + (a * c)"},
};

const Rule kProducts[] = {
    {"0 * a", "0"},
    {"a * -0", "0"},
    {"-a * 0", "0"},
    {"1 * a", "a"},
    {"-1 * a", "-a"},
    {"a * -1", "-a"},
    {"2 * 3", "6"},
    {"-2 * 3", "-6"},
    {"a * 2", "2 * a"},
    {"2 * (3 * a)", "6 * a"},
    {"-2 * (3 * a)", "-(6 * a)"},
    {"0.5 * (2 * a)", "a"},
    {"a * b", "a * b"},
    {"b * a", "a * b"},
    {"-a * b", "-(a * b)"},
    {"-a * -b", "a * b"},
    {"a * -b", "-(a * b)"},
    {"(2 * a) * b", "b * (2 * a)"},
    {"a * (b + c)", "a * (b + c)"},
};

const Rule kQuotients[] = {
    {"0 / a", "0"},         {"a / 1", "a"},     {"a / a", "1"},         {"-a / a", "-1"},
    {"6 / 3", "2"},         {"6 / -3", "-2"},   {"a / 4", "0.25 * a"},  {"a / -4", "-(0.25 * a)"},
    {"8 * a / 4", "2 * a"}, {"1 / a", "1 / a"}, {"-a / b", "-(a / b)"}, {"a / -b", "-(a / b)"},
    {"a / 0", "a / 0"},
};

const Rule kFunctions[] = {
    {"sin(0)", "0"},
    {"cos(0)", "1"},
    {"sin(a)", "sin(a)"},
    {"sin(-a)", "-sin(a)"},
    {"cos(-a)", "cos(a)"},
    {"sin(b - a)", "-sin(a - b)"},
    {"cos(b - a)", "cos(a - b)"},
    {"sin(a - a)", "0"},
    {"sin(sin(-a))", "-sin(sin(a))"},
    {"sqrt(9)", "3"},
    {"sqrt(a)", "sqrt(a)"},
    {"sqrt(-a)", "sqrt(-a)"},
};

std::string numbered(const testing::TestParamInfo<Rule>& info) {
  return "line" + std::to_string(info.index + 1);
}
INSTANTIATE_TEST_SUITE_P(Sums, BuilderRules, testing::ValuesIn(kSums), numbered);
INSTANTIATE_TEST_SUITE_P(Products, BuilderRules, testing::ValuesIn(kProducts), numbered);
INSTANTIATE_TEST_SUITE_P(Quotients, BuilderRules, testing::ValuesIn(kQuotients), numbered);
INSTANTIATE_TEST_SUITE_P(Functions, BuilderRules, testing::ValuesIn(kFunctions), numbered);

TEST(Builder, EqualExpressionsAreOneNode) {
  Builder builder("f");
  const auto q = builder.input("q", 2);
  const Ref sum = builder.add(q[0], q[1]);
  EXPECT_TRUE(builder.add(q[1], q[0]) == sum);
  EXPECT_TRUE(builder.add(-q[1], -q[0]) == -sum);
  const Ref product = builder.mul(q[0], q[1]);
  EXPECT_TRUE(builder.mul(q[1], -q[0]) == -product);
  EXPECT_TRUE(builder.sin(-q[0]) == -builder.sin(q[0]));
  EXPECT_TRUE(builder.constant(2.5) == -builder.constant(-2.5));
  EXPECT_TRUE(builder.constant(-0.0) == builder.constant(0.0));
  EXPECT_FALSE(builder.div(q[0], q[1]) == builder.div(q[1], q[0]));
  EXPECT_FALSE(builder.sin(q[0]) == builder.cos(q[0]));
}

TEST(Builder, SumsAreHashConsed) {
  Builder builder("f");
  const auto q = builder.input("q", 3);
  const std::vector<Term> terms{{q[0], Ref(), false}, {-q[1], q[2], true}};
  const Ref sum = builder.sum(terms);
  EXPECT_TRUE(builder.sum(terms) == sum);
  EXPECT_EQ(builder.region().terms.size(), 2u);
  EXPECT_FALSE(builder.sum({{q[0], Ref(), false}, {q[1], q[2], true}}) == sum);
  EXPECT_FALSE(builder.sum({{q[0], Ref(), false}, {-q[1], Ref(), false}}) == sum);
}

TEST(Builder, HashConsingSurvivesGrowth) {
  Builder builder("f");
  const auto q = builder.input("q", 1);
  std::vector<Ref> first;
  for (int k = 0; k < 5000; ++k) first.push_back(builder.mul(builder.constant(k + 2.5), q[0]));
  const size_t size = builder.region().nodes.size();
  for (int k = 0; k < 5000; ++k)
    ASSERT_TRUE(builder.mul(q[0], builder.constant(k + 2.5)) == first[static_cast<size_t>(k)]);
  EXPECT_EQ(builder.region().nodes.size(), size);
  EXPECT_EQ(builder.region().constants.size(), 5000u);
}

TEST(Builder, NodesBelongToTheBlockThatMadeThem) {
  Builder builder("f");
  const auto q = builder.input("q", 2);
  builder.begin_block("one");
  builder.begin_block("one");
  const Ref x = builder.add(q[0], q[1]);
  builder.begin_block("two");
  EXPECT_TRUE(builder.add(q[0], q[1]) == x);
  const Ref y = builder.mul(q[0], q[1]);
  const Region& region = builder.region();
  EXPECT_EQ(region.blocks, (std::vector<std::string>{"", "one", "two"}));
  EXPECT_EQ(region[x].block, 1);
  EXPECT_EQ(region[y].block, 2);
}

TEST(References, CarryASign) {
  const Ref x(7), minus(7, true);
  EXPECT_TRUE(-x == minus);
  EXPECT_TRUE(-minus == x);
  EXPECT_TRUE(minus.positive() == x);
  EXPECT_TRUE(x.with_sign_of(minus) == minus);
  EXPECT_TRUE(minus.with_sign_of(minus) == x);
  EXPECT_EQ(minus.node(), 7u);
  EXPECT_FALSE(x == minus);
}

}  // namespace
}  // namespace arboc::test

// Chain rules of random sums, on threads, and how lists are shared out.
#include <gtest/gtest.h>

#include <arboc/nlp/scalars.hpp>
#include <set>

#include "unit/nlp_support.h"

namespace arboc::test {
namespace {

using namespace nlp;

std::set<std::pair<int, int>> entries(const Pattern& p) {
  std::set<std::pair<int, int>> all;
  for (std::size_t k = 0; k < p.size(); ++k) all.insert({p.row[k], p.col[k]});
  return all;
}

constexpr int kVariables = 40, kTogether = 10;

/// A sum of some of the variables from `at` on that are together with it, some of them twice or
/// with coefficients that cancel.
Affine random_sum(const Quantities& x, int at, std::mt19937_64& random) {
  const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  Affine sum = number();
  for (int k = at; k < std::min(at + 4, (at / kTogether + 1) * kTogether); ++k) {
    if (number() < -0.6) continue;
    const double c = number();
    sum += c * Affine(x[k]);
    if (number() < -0.5) sum += number() * Affine(x[k]);
    if (number() < -0.7) sum += -c * Affine(x[k]);
  }
  return sum;
}

/// Many evaluations whose inputs share variables with others, as curves do, in groups that have
/// nothing to do with one another, as joints of two bodies.
Problem random_problem(unsigned seed) {
  std::mt19937_64 random(seed);
  const auto f = std::make_shared<Sample>();
  Problem p;
  const auto x = p.add_variables("x", "m", std::vector<Interval>(kVariables));
  const int g = p.add_group("rows", "m");
  for (int k = 0; k < 25; ++k) {
    const int first = k % (kVariables / kTogether) * kTogether;
    const auto one = [&] { return first + static_cast<int>(random() % kTogether); };
    const int a = one(), b = one(), c = one();
    const auto y = p.evaluate(
        f, {random_sum(x, a, random), random_sum(x, b, random), random_sum(x, c, random)});
    Affine sum = x[a];
    for (int i = 0; i < y.size(); ++i) sum += (0.3 + i) * Affine(y[i]);
    p.require(g, sum, 0, 0);
    p.minimise("cost", 0.3, square(), {y[0] - 2 * x[b]});
  }
  return p;
}

TEST(Chain, DerivativesOfRandomSumsAreExact) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    Assembly nlp(random_problem(seed));
    std::mt19937_64 random(seed + 100);
    const VectorXd x = 0.5 * random_vector(kVariables, random);
    const VectorXd lambda = random_vector(static_cast<Eigen::Index>(nlp.rows().size()), random);
    const DerivativeErrors e = derivative_errors(nlp, x, lambda, 0.7);
    EXPECT_LT(e.gradient, 1e-9) << seed;
    EXPECT_LT(e.jacobian, 1e-9) << seed;
    EXPECT_LT(e.hessian, 1e-9) << seed;
    EXPECT_EQ(entries(nlp.hessian_pattern()).size(), nlp.hessian_pattern().size());
  }
}

TEST(Chain, ThreadsChangeNoBit) {
  for (const int count : {2, 3, 7}) {
    Assembly one(random_problem(5)), many(random_problem(5));
    many.use_threads(count);
    std::mt19937_64 random(3);
    const VectorXd x = random_vector(kVariables, random);
    const VectorXd lambda = random_vector(static_cast<Eigen::Index>(one.rows().size()), random);
    for (Assembly* nlp : {&one, &many}) nlp->move_to(x.data());
    EXPECT_EQ(one.jacobian(), many.jacobian());
    EXPECT_EQ(one.hessian(0.7, lambda.data()), many.hessian(0.7, lambda.data()));
  }
}

TEST(Chain, EntriesThatCannotBeAreNotListed) {
  Problem p;
  const auto x = p.add_variables("x", "m", std::vector<Interval>(4));
  // The first input depends on x0 alone, the third on x1 and x2, whatever is written there.
  const auto y =
      p.evaluate(std::make_shared<Sample>(), {x[0] + 2 * x[3] - 2 * x[3], 0.5, x[1] - 3 * x[2]});
  p.require(p.add_group("row", "m"), y[0] + y[1] + y[2], 0, 0);
  Assembly nlp(p);
  for (const auto& [row, col] : entries(nlp.hessian_pattern())) EXPECT_LT(row, 3) << col;
  for (const auto& [row, col] : entries(nlp.jacobian_pattern())) EXPECT_LT(col, 3) << row;
}

TEST(Chain, PartsDoNotOverlap) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 200; ++round) {
    const int n = static_cast<int>(random() % 30), members = 1 + static_cast<int>(random() % 5);
    std::vector<int> low, high;
    for (int k = 0; k < n; ++k) {
      low.push_back(k + static_cast<int>(random() % 4));
      high.push_back(low.back() + static_cast<int>(random() % 3));
    }
    const std::vector<int> parts = parts_of(low, high, members);
    ASSERT_EQ(parts.size(), static_cast<std::size_t>(members) + 1);
    EXPECT_EQ(parts.front(), 0);
    EXPECT_EQ(parts.back(), n);
    for (int m = 0; m < members; ++m) {
      ASSERT_LE(parts[m], parts[m + 1]);
      for (int a = 0; a < parts[m + 1]; ++a)
        for (int b = parts[m + 1]; b < n; ++b) EXPECT_LT(high[a], low[b]);
    }
  }
  // Where nothing overlaps, parts are even.
  EXPECT_EQ(parts_of({0, 1, 2, 3, 4, 5}, {0, 1, 2, 3, 4, 5}, 3), (std::vector<int>{0, 2, 4, 6}));
}

}  // namespace
}  // namespace arboc::test

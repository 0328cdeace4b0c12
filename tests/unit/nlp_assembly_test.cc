// Problems in parts: the chain rule, and what is done once.
#include <gtest/gtest.h>

#include <arboc/nlp/scalars.hpp>
#include <set>

#include "unit/nlp_support.h"

namespace arboc::test {
namespace {

using namespace nlp;

// Differences of sixth order with steps of 1e-3 leave rounding of some 1e-13 / 1e-3.
constexpr double kTolerance = 1e-9;

void expect_exact(Nlp& nlp, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto n = static_cast<Eigen::Index>(nlp.variables().size());
  const auto m = static_cast<Eigen::Index>(nlp.rows().size());
  for (int k = 0; k < 5; ++k) {
    const DerivativeErrors e =
        derivative_errors(nlp, random_vector(n, random), random_vector(m, random), 0.7);
    EXPECT_LT(e.gradient, kTolerance);
    EXPECT_LT(e.jacobian, kTolerance);
    EXPECT_LT(e.hessian, kTolerance);
  }
}

/// Inputs that share variables, outputs in rows, scalars of both, costs of all kinds.
Problem mixed(const std::shared_ptr<Sample>& f) {
  Problem p;
  const auto x = p.add_variables("x", "m", std::vector<Interval>(5));
  const auto y = p.evaluate(f, {x[0], 2 * x[0] - x[1] + 0.3, x[2]});
  const auto z = p.evaluate(f, {x[1] + 0.5 * x[3], x[1], 0.25 * x[1] + x[4]});
  const int g = p.add_group("affine", "m"), h = p.add_group("curved", "m^2");
  p.require(g, y[0] - 3 * z[1] + 2 * x[0], 0, 0);
  p.require(g, 0.5 * y[2] + x[4], -1, 1);
  p.require(h, dot(2), {y[0], x[3], z[0] + x[0], 1.5 * y[1]}, -2 * x[2] + z[2], 0, 4);
  p.require(h, rounded_norm(3, 0.1), {x[0], y[1], x[0] - z[0]}, {}, 0, 2);
  p.minimise("height", 0.5, square(), {y[1] - z[0]});
  p.minimise("height", 2, square(), {x[4]});
  p.minimise("length", 3, Affine(z[1]) + x[2]);
  return p;
}

TEST(Assembly, DerivativesOfMixedProblemsAreExact) {
  Assembly nlp(mixed(std::make_shared<Sample>()));
  EXPECT_EQ(nlp.rows().size(), 4U);
  expect_exact(nlp, 1);
}

TEST(Assembly, PatternsHaveNoEntryTwiceAndTheHessianIsLower) {
  Assembly nlp(mixed(std::make_shared<Sample>()));
  for (const Pattern* p : {&nlp.jacobian_pattern(), &nlp.hessian_pattern()}) {
    std::set<std::pair<int, int>> seen;
    for (std::size_t k = 0; k < p->size(); ++k)
      EXPECT_TRUE(seen.insert({p->row[k], p->col[k]}).second);
  }
  const Pattern& H = nlp.hessian_pattern();
  for (std::size_t k = 0; k < H.size(); ++k) EXPECT_GE(H.row[k], H.col[k]);
}

TEST(Assembly, EvaluatesAFunctionOncePerPointForAllThatAsk) {
  const auto f = std::make_shared<Sample>();
  Assembly nlp(mixed(f));
  f->calls = 0;
  const std::vector<double> x(5, 0.2), lambda(4, 1);
  nlp.move_to(x.data());
  nlp.objective();
  nlp.constraints();
  nlp.gradient();
  nlp.jacobian();
  nlp.hessian(1, lambda.data());
  EXPECT_EQ(f->calls, 1);  // both evaluations in one call
}

TEST(Assembly, WeightsAndBoundsMoveBetweenSolutions) {
  Assembly nlp(mixed(std::make_shared<Sample>()));
  const std::vector<double> x{0.1, -0.2, 0.3, 0.4, -0.5};
  nlp.move_to(x.data());
  const auto costs = nlp.costs();
  EXPECT_NEAR(nlp.objective(),
              0.5 * (costs.at("height") - 0.25) + 2 * 0.25 + 3 * costs.at("length"), 1e-14);
  EXPECT_TRUE(nlp.set_weight("length", 0));
  EXPECT_FALSE(nlp.set_weight("width", 1));
  nlp.move_to(x.data());
  EXPECT_NEAR(nlp.objective(), 0.5 * (costs.at("height") - 0.25) + 2 * 0.25, 1e-14);
  expect_exact(nlp, 2);
  nlp.set_row(0, 1, -0.5, 0.5);
  EXPECT_EQ(nlp.rows().upper[1], 0.5);
  EXPECT_THROW(nlp.set_row(0, 1, 1, 0), std::invalid_argument);
}

TEST(Assembly, RowsOfNoVariableHoldOrAreRefusedByName) {
  Problem p;
  const auto x = p.add_variables("x", "m", {Interval{}});
  const auto y = p.evaluate(std::make_shared<Sample>(), {0.5, x[0], 2.0});
  const int g = p.add_group("depth", "m");
  p.require(g, y[1], std::exp(1.0), std::exp(1.0));
  p.require(g, y[2], 0, 0);
  EXPECT_EQ(Assembly(p).rows().size(), 1U);
  p.require(g, y[1], 0, 0);
  try {
    Assembly refused(p);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "'depth': a row depends on no variable and does not hold");
  }
}

TEST(Problem, RefusesWhatDoesNotFit) {
  Problem p;
  const auto x = p.add_variables("x", "m", {Interval{}});
  EXPECT_THROW(p.add_variables("y", "m", {{1, 0, 1}}), std::invalid_argument);
  EXPECT_THROW(p.evaluate(std::make_shared<Sample>(), {x[0]}), std::invalid_argument);
  EXPECT_THROW(p.minimise("cost", 1, Affine(x[3])), std::out_of_range);
  EXPECT_THROW(p.minimise("cost", 1, dot(1), {x[0]}), std::invalid_argument);
  const auto y = p.evaluate(std::make_shared<Sample>(), {x[0], x[0], x[0]});
  EXPECT_THROW(p.evaluate(std::make_shared<Sample>(), {y[0], x[0], x[0]}), std::invalid_argument);
}

/// A scalar function by differences; `spread` keeps arguments off its edges.
void expect_scalar(const ScalarPointer& f, unsigned seed) {
  std::mt19937_64 random(seed);
  const int n = f->arguments();
  for (int k = 0; k < 10; ++k) {
    const VectorXd z = 1.5 * random_vector(n, random);
    VectorXd g(n);
    MatrixXd H(n, n);
    f->derivatives(z.data(), g.data(), H.data());
    const auto value = [&](const VectorXd& at) {
      return VectorXd::Constant(1, f->value(at.data()));
    };
    const auto slope = [&](const VectorXd& at) {
      VectorXd s(n);
      MatrixXd unused(n, n);
      f->derivatives(at.data(), s.data(), unused.data());
      return s;
    };
    const double one = std::max(1.0, H.cwiseAbs().maxCoeff());
    for (int i = 0; i < n; ++i) {
      EXPECT_NEAR(g[i], difference(value, z, i, 1e-3)[0], kTolerance * one);
      const VectorXd column = difference(slope, z, i, 1e-3);
      for (int j = 0; j < n; ++j) {
        EXPECT_NEAR(H(j, i), column[j], kTolerance * one);
        if (!f->curved(i, j)) {
          EXPECT_EQ(H(i, j), 0);
        }
      }
    }
  }
}

TEST(Scalars, DerivativesAreExact) {
  expect_scalar(square(), 1);
  expect_scalar(dot(3), 2);
  expect_scalar(squared_norm(3), 3);
  expect_scalar(rounded_norm(2, 0.5), 4);
  expect_scalar(off_direction(), 5);
  Eigen::Vector3d lower(-1, -2, -3), upper(2, 1, 3);
  expect_scalar(normalised_norm(lower, upper, 8), 6);
  for (const double z : {-0.7, 0.4}) {
    double g = 0, H = 0;
    const auto f = normalised_square(-2, 1);
    f->derivatives(&z, &g, &H);
    const double limit = z < 0 ? -2 : 1;
    EXPECT_DOUBLE_EQ(f->value(&z), z * z / limit / limit);
    EXPECT_DOUBLE_EQ(g, 2 * z / limit / limit);
    EXPECT_DOUBLE_EQ(H, 2 / limit / limit);
  }
}

}  // namespace
}  // namespace arboc::test

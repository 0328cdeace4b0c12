// B-splines against the recursion (3.3) of [Thesis] as it is printed, run on Taylor series.
#include "arboc/motion/bspline.hpp"

#include <gtest/gtest.h>

#include <array>

#include "support/random.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kEps = 0x1p-52;

/// A polynomial in h, t = t0 + h: coefficient k is the k-th derivative over k!.
struct Taylor {
  static constexpr int kTerms = 10;
  std::array<double, kTerms> c{};
};
Taylor operator*(const Taylor& a, const Taylor& b) {
  Taylor r;
  for (size_t i = 0; i < a.c.size(); ++i)
    for (size_t j = 0; i + j < a.c.size(); ++j) r.c[i + j] += a.c[i] * b.c[j];
  return r;
}
Taylor operator+(Taylor a, const Taylor& b) {
  for (size_t i = 0; i < a.c.size(); ++i) a.c[i] += b.c[i];
  return a;
}

/// N_i,p around t of the span u_s <= t < u_{s+1}, by (3.3) with 0/0 = 0.
Taylor textbook(const std::vector<double>& u, int i, int p, double t, int s) {
  Taylor result;
  if (p == 0) {
    result.c[0] = i == s ? 1 : 0;
    return result;
  }
  const auto at = [&](int k) { return u[static_cast<size_t>(k)]; };
  const double left = at(i + p) - at(i), right = at(i + p + 1) - at(i + 1);
  if (left > 0)
    result = result + Taylor{{(t - at(i)) / left, 1 / left}} * textbook(u, i, p - 1, t, s);
  if (right > 0)
    result = result +
             Taylor{{(at(i + p + 1) - t) / right, -1 / right}} * textbook(u, i + 1, p - 1, t, s);
  return result;
}

double factorial(int k) { return k < 2 ? 1 : k * factorial(k - 1); }

/// Knots with some that coincide, ends clamped or not.
BSplineBasis random_basis(Random& random, int degree) {
  const auto count = static_cast<size_t>(2 * degree + 2 + random.integer(8));
  const bool clamped = random.chance(0.6);
  std::vector<double> knots(1, random.uniform(-2, 2));
  int multiplicity = 1;
  while (knots.size() < count) {
    const bool begin = clamped && static_cast<int>(knots.size()) <= degree;
    const bool same = begin || (multiplicity < degree && random.chance(0.25));
    multiplicity = same ? multiplicity + 1 : 1;
    knots.push_back(knots.back() + (same ? 0 : random.uniform(0.1, 1)));
  }
  const auto p = static_cast<size_t>(degree);
  if (knots[p] == knots[p + 1] || knots[count - p - 2] == knots[count - p - 1])
    return random_basis(random, degree);  // the first or the last span is empty
  return BSplineBasis(degree, knots);
}

double random_instant(Random& random, const BSplineBasis& basis) {
  if (random.chance(0.2)) {
    const double knot =
        basis.knots()[static_cast<size_t>(random.integer(static_cast<int>(basis.knots().size())))];
    return std::clamp(knot, basis.begin(), basis.end());
  }
  return random.uniform(basis.begin(), basis.end());
}

TEST(BSpline, CountsAreThoseOfTheThesis) {
  for (const auto& [points, knots] : {std::pair{5, 9}, {12, 16}, {23, 27}}) {
    const auto basis = BSplineBasis::clamped_uniform(3, points, 0, 30);
    EXPECT_EQ(basis.size(), points);
    EXPECT_EQ(basis.knots().size(), static_cast<size_t>(knots));
    EXPECT_EQ(basis.spans().size(), static_cast<size_t>(points - 3));
  }
  const auto five = BSplineBasis::clamped_uniform(3, 5, 0, 1);
  EXPECT_EQ(five.knots(), (std::vector<double>{0, 0, 0, 0, 0.5, 1, 1, 1, 1}));
}

TEST(BSpline, ValuesAndDerivativesAreTheRecursions) {
  for (const auto seed : seeds(300)) {
    Random random(seed);
    const int p = random.integer(8);
    const BSplineBasis basis = random_basis(random, p);
    const double t = random_instant(random, basis);
    const int s = basis.span(t);
    ASSERT_LT(basis.knot(s), basis.knot(s + 1)) << seed;
    const MatrixXd rows = basis.derivatives(t, p + 1);
    for (int i = 0; i < basis.size(); ++i) {
      const Taylor exact = textbook(basis.knots(), i, p, t, s);
      const bool local = s - p <= i && i <= s;
      for (int k = 0; k <= p + 1; ++k) {
        const double value = local ? rows(k, i - s + p) : 0;
        // Differences of knots up to 10 over spans of 0.1 and more, up to seven times.
        EXPECT_NEAR(value, exact.c[static_cast<size_t>(k)] * factorial(k),
                    1024 * kEps * rows.row(k).cwiseAbs().maxCoeff() + 1e-300)
            << "seed " << seed << " N_" << i << "," << p << " derivative " << k;
      }
    }
  }
}

TEST(BSpline, SumsToOneAndReproducesTime) {
  for (const auto seed : seeds(300)) {
    Random random(seed);
    const int p = 1 + random.integer(7);
    const BSplineBasis basis = random_basis(random, p);
    const double t = random_instant(random, basis);
    const MatrixXd rows = basis.derivatives(t, 1);
    EXPECT_NEAR(rows.row(0).sum(), 1, 8 * kEps) << seed;
    EXPECT_GE(rows.row(0).minCoeff(), 0) << seed;
    const VectorXd g = basis.greville();
    const int first = basis.span(t) - p;
    EXPECT_NEAR(rows.row(0) * g.segment(first, p + 1), t, 1e-14) << seed;
  }
}

TEST(BSpline, CubicsOfTheThesisSumToOne) {
  for (const int points : {5, 12, 23}) {
    const auto basis = BSplineBasis::clamped_uniform(3, points, 0, 2);
    for (int n = 0; n <= 1000; ++n)
      EXPECT_NEAR(basis.derivatives(n / 500.0, 0).sum(), 1, 1e-15) << points << " " << n;
  }
}

TEST(BSpline, BeginsAndEndsInItsControlPoints) {
  Random random(1);
  for (int p = 0; p < 8; ++p) {
    const auto basis = BSplineBasis::clamped_uniform(p, p + 4, -1, 2);
    const MatrixXd P = MatrixXd::Random(3, p + 4);
    const BSpline q(basis, P);
    EXPECT_LE((q(-1) - P.col(0)).norm(), 4 * kEps);
    EXPECT_LE((q(2) - P.col(p + 3)).norm(), 4 * kEps);
    // What rounding puts beyond the ends; more is refused.
    EXPECT_LE((q(2 * (1 + kEps)) - P.col(p + 3)).norm(), 1e-13);
    EXPECT_LE((q(-1 - kEps) - P.col(0)).norm(), 1e-13);
    EXPECT_THROW(q(2.001), std::domain_error);
    EXPECT_THROW(q(std::nan("")), std::domain_error);
  }
}

TEST(BSpline, EqualControlPointsAtAnEndAreRest) {
  const auto basis = BSplineBasis::clamped_uniform(3, 12, 0, 5);
  MatrixXd P = MatrixXd::Random(2, 12);
  P.col(1) = P.col(2) = P.col(0);
  P.col(10) = P.col(9) = P.col(11);
  const BSpline q(basis, P);
  for (const int k : {1, 2}) {
    EXPECT_LE(q(0, k).norm(), 1e-14) << k;
    EXPECT_LE(q(5, k).norm(), 1e-13) << k;
  }
  EXPECT_GT(q(0, 3).norm(), 1e-3);
}

TEST(BSpline, ControlPointsActOnTheirSpansOnly) {
  // d^(k+1) q / dt^k dP_i is the basis value, (3.9): exactly, as q is linear in P.
  for (const auto seed : seeds(50)) {
    Random random(seed);
    const int p = 1 + random.integer(5);
    const BSplineBasis basis = random_basis(random, p);
    const MatrixXd P = MatrixXd::Zero(1, basis.size());
    const double t = random_instant(random, basis);
    const int first = basis.span(t) - p;
    int touched = 0;
    for (int i = 0; i < basis.size(); ++i) {
      MatrixXd moved = P;
      moved(0, i) = 1;
      for (int k = 0; k <= p; ++k) {
        const bool local = first <= i && i <= first + p;
        const double expected = local ? basis.derivative(t, k)[i - first] : 0;
        EXPECT_EQ(BSpline(basis, moved)(t, k)[0], expected);
        if (k == 0 && expected != 0) ++touched;
      }
    }
    EXPECT_LE(touched, p + 1);
  }
}

TEST(BSpline, DerivativesAreCurves) {
  for (const auto seed : seeds(100)) {
    Random random(seed);
    const int p = 1 + random.integer(5);
    const BSplineBasis basis = random_basis(random, p);
    const BSpline q(basis, MatrixXd::Random(2, basis.size()));
    const double t = random_instant(random, basis);
    const int last = std::min(p, basis.continuous_derivatives() + 1);
    for (int k = 0; k <= last; ++k) {
      const double scale = q.derivative(k).points().cwiseAbs().maxCoeff() + 1;
      EXPECT_LE((q.derivative(k)(t) - q(t, k)).norm(), 1e-12 * scale) << seed << " " << k;
    }
    EXPECT_EQ(q(t, p + 1).norm(), 0);
    EXPECT_THROW(q.derivative(last + 1), std::invalid_argument);
  }
}

TEST(BSpline, StaysBetweenItsControlPoints) {
  Random random(3);
  const auto basis = BSplineBasis::clamped_uniform(3, 12, 0, 3);
  const BSpline q(basis, MatrixXd::Random(4, 12));
  const BSpline speed = q.derivative();
  const CurveBounds all = q.bounds(), fast = speed.bounds();
  double widest = 0, narrow = 0;
  for (int n = 0; n < 10000; ++n) {
    const double t = 3.0 * n / 9999, later = std::min(3.0, t + 0.1);
    const CurveBounds here = q.bounds(t, later);
    const VectorXd x = q(t), v = q(t, 1);
    for (int i = 0; i < 4; ++i) {
      ASSERT_LE(all.lower[i], x[i] + 4 * kEps);
      ASSERT_LE(x[i], all.upper[i] + 4 * kEps);
      ASSERT_LE(here.lower[i], x[i] + 4 * kEps);
      ASSERT_LE(x[i], here.upper[i] + 4 * kEps);
      ASSERT_LE(fast.lower[i], v[i] + 64 * kEps);
      ASSERT_LE(v[i], fast.upper[i] + 64 * kEps);
    }
    widest = std::max(widest, (all.upper - all.lower).maxCoeff());
    narrow = std::max(narrow, (here.upper - here.lower).minCoeff());
  }
  EXPECT_LT(narrow, widest);
}

TEST(BSpline, MoreKnotsLeaveTheCurveAndNarrowItsBounds) {
  for (const auto seed : seeds(100)) {
    Random random(seed);
    const int p = 1 + random.integer(5);
    const auto basis = BSplineBasis::clamped_uniform(p, p + 3, 0, 2);
    const BSpline q(basis, MatrixXd::Random(2, p + 3));
    const BSpline one = q.with_knot(random.uniform(0.01, 1.99)), half = q.refined();
    EXPECT_EQ(one.basis().size(), p + 4);
    EXPECT_EQ(half.basis().spans().size(), 6u);
    for (int n = 0; n <= 50; ++n) {
      const double t = n / 25.0;
      EXPECT_LE((one(t) - q(t)).norm(), 1e-14);
      EXPECT_LE((half(t) - q(t)).norm(), 1e-14);
    }
    const CurveBounds before = q.bounds(), after = half.bounds();
    EXPECT_TRUE((before.lower.array() <= after.lower.array() + 4 * kEps).all());
    EXPECT_TRUE((after.upper.array() <= before.upper.array() + 4 * kEps).all());
  }
  // As often as the degree allows in one place, where the curve then passes its control point.
  BSpline q(BSplineBasis::clamped_uniform(3, 6, 0, 3), MatrixXd::Random(1, 6));
  const VectorXd there = q(1.0);
  for (int n = 0; n < 2; ++n) q = q.with_knot(1.0);
  EXPECT_EQ(q.basis().continuous_derivatives(), 0);
  EXPECT_LE((q.points().array() - there[0]).abs().minCoeff(), 1e-15);
  EXPECT_THROW(q.with_knot(0), std::invalid_argument);
}

TEST(BSpline, SaysHowSmoothItIs) {
  EXPECT_EQ(BSplineBasis::clamped_uniform(3, 12, 0, 1).continuous_derivatives(), 2);
  EXPECT_EQ(BSplineBasis::clamped_uniform(5, 12, 0, 1).continuous_derivatives(), 4);
  EXPECT_EQ(BSplineBasis(2, {0, 0, 0, 1, 1, 2, 2, 2}).continuous_derivatives(), 0);
  EXPECT_EQ(BSplineBasis(0, {0, 1, 2}).continuous_derivatives(), -1);
}

TEST(BSpline, RefusesWhatIsNone) {
  EXPECT_THROW(BSplineBasis(-1, {0, 1}), std::invalid_argument);
  EXPECT_THROW(BSplineBasis(1, {0, 1}), std::invalid_argument);
  EXPECT_THROW(BSplineBasis(1, {0, 0, 2, 1}), std::invalid_argument);
  EXPECT_THROW(BSplineBasis(1, {0, 0, 0, 1, 1}), std::invalid_argument);
  EXPECT_THROW(BSplineBasis(2, {0, 1, 2, 2, 3, 4, 5}), std::invalid_argument);
  EXPECT_THROW(BSplineBasis(1, {0, 0, std::nan(""), 1}), std::invalid_argument);
  EXPECT_THROW(BSplineBasis::clamped_uniform(3, 3, 0, 1), std::invalid_argument);
  EXPECT_THROW(BSplineBasis::clamped_uniform(3, 4, 1, 1), std::invalid_argument);
  const auto basis = BSplineBasis::clamped_uniform(3, 4, 0, 1);
  EXPECT_THROW(BSpline(basis, MatrixXd::Zero(2, 5)), std::invalid_argument);
  EXPECT_THROW(basis.derivatives(0.5, -1), std::invalid_argument);
  EXPECT_THROW(BSpline(basis, MatrixXd::Zero(2, 4)).bounds(0.5, 0.4), std::invalid_argument);
}

}  // namespace
}  // namespace arboc::test

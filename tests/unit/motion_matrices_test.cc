// Basis matrices, integrals and fits of B-splines.
#include "arboc/motion/basis_matrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "support/random.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(Quadrature, IsExactUpToItsDegree) {
  for (int m = 1; m <= 20; ++m) {
    const Quadrature rule = gauss_legendre(m);
    EXPECT_NEAR(rule.weights.sum(), 2, 1e-14);
    for (int k = 0; k < 2 * m; ++k) {
      const double exact = k % 2 == 0 ? 2.0 / (k + 1) : 0;
      const double sum = (rule.weights.array() * rule.instants.array().pow(k)).sum();
      EXPECT_NEAR(sum, exact, 1e-14) << m << " points, power " << k;
    }
    const double beyond = (rule.weights.array() * rule.instants.array().pow(2 * m)).sum();
    EXPECT_GT(std::fabs(beyond - 2.0 / (2 * m + 1)), m < 10 ? 1e-8 : 0) << m;
    for (int k = 0; k + 1 < m; ++k) EXPECT_LT(rule.instants[k], rule.instants[k + 1]);
  }
  EXPECT_THROW(gauss_legendre(0), std::invalid_argument);
}

TEST(BasisMatrix, IsTheCurveAtAllInstants) {
  Random random(1);
  const auto basis = BSplineBasis::clamped_uniform(3, 23, 0, 2);
  const MatrixXd P = MatrixXd::Random(5, 23);
  const BSpline q(basis, P);
  const VectorXd instants = VectorXd::LinSpaced(40, 0, 2);
  for (int k = 0; k <= 4; ++k) {
    const BasisRows rows = basis_rows(basis, instants, k);
    const SparseRows B = rows.sparse();
    EXPECT_EQ(B.nonZeros(), 40 * 4);  // one pattern for all derivatives, also for the zero one
    const MatrixXd Q = P * B.transpose();
    for (int n = 0; n < 40; ++n)
      EXPECT_LE((Q.col(n) - q(instants[n], k)).norm(), 1e-13 * std::pow(40, k)) << k << " " << n;
    for (size_t n = 1; n < 40; ++n) EXPECT_LE(rows.first[n - 1], rows.first[n]);
  }
}

TEST(BasisMatrix, ChangesOfControlPointsAreItsColumns) {
  // d q^(k)(t) / dP_i by a difference, which is exact for a linear function.
  const auto basis = BSplineBasis::clamped_uniform(4, 9, 1, 3);
  const VectorXd instants = VectorXd::LinSpaced(7, 1, 3);
  const MatrixXd P = MatrixXd::Random(1, 9);
  for (int k = 0; k <= 3; ++k) {
    const MatrixXd B = basis_rows(basis, instants, k).sparse();
    for (int i = 0; i < 9; ++i) {
      MatrixXd moved = P;
      moved(0, i) += 1;
      for (int n = 0; n < 7; ++n)
        EXPECT_NEAR(BSpline(basis, moved)(instants[n], k)[0] - BSpline(basis, P)(instants[n], k)[0],
                    B(n, i), 1e-12 * std::pow(10, k));
    }
  }
}

TEST(BasisMatrix, IntegralsAreExact) {
  for (int p = 1; p <= 5; ++p) {
    const auto basis = BSplineBasis::clamped_uniform(p, p + 6, 0, 3);
    const Quadrature rule = span_quadrature(basis, (p + 2) / 2);  // of degree p
    const MatrixXd B = basis_rows(basis, rule.instants, 0).sparse();
    const VectorXd integrals = B.transpose() * rule.weights;
    for (int i = 0; i < basis.size(); ++i)
      EXPECT_NEAR(integrals[i], basis.integral(i), 1e-15 * 8) << p << " " << i;
    EXPECT_NEAR(rule.weights.sum(), 3, 1e-14);
    EXPECT_EQ(rule.instants.size(), 7 * ((p + 2) / 2) - ((p + 2) / 2));
  }
}

TEST(BasisMatrix, GramMatrixIsBandedAndExact) {
  const auto basis = BSplineBasis::clamped_uniform(3, 10, 0, 4);
  const BSpline f(basis, MatrixXd::Random(1, 10)), g(basis, MatrixXd::Random(1, 10));
  const Quadrature fine = span_quadrature(basis, 12);
  for (const auto& [k, l] : {std::pair{0, 0}, {1, 1}, {2, 2}, {0, 2}, {3, 3}}) {
    const Eigen::SparseMatrix<double> G = gram_matrix(basis, k, l);
    double integral = 0;
    for (Eigen::Index n = 0; n < fine.instants.size(); ++n)
      integral += fine.weights[n] * f(fine.instants[n], k)[0] * g(fine.instants[n], l)[0];
    EXPECT_NEAR((f.points() * G * g.points().transpose())(0, 0), integral, 1e-12 * (1 + k * 100));
    for (int c = 0; c < G.outerSize(); ++c)
      for (Eigen::SparseMatrix<double>::InnerIterator it(G, c); it; ++it)
        EXPECT_LE(std::abs(it.row() - it.col()), 3);
  }
  // A straight line has no acceleration, and a speed of 1.
  const Eigen::RowVectorXd line = basis.greville().transpose();
  EXPECT_NEAR((line * gram_matrix(basis, 2, 2) * line.transpose())(0, 0), 0, 1e-11);
  EXPECT_NEAR((line * gram_matrix(basis, 1, 1) * line.transpose())(0, 0), 4, 1e-12);
}

TEST(BasisMatrix, FitReturnsCurvesOfTheBasisAndPassesValues) {
  Random random(2);
  const auto basis = BSplineBasis::clamped_uniform(3, 12, 0, 5);
  const BSpline q(basis, MatrixXd::Random(3, 12));
  const VectorXd many = VectorXd::LinSpaced(60, 0, 5), just = basis.greville();
  for (const VectorXd& instants : {many, just}) {
    MatrixXd values(3, instants.size());
    for (Eigen::Index n = 0; n < instants.size(); ++n) values.col(n) = q(instants[n]);
    EXPECT_LE((fit(basis, instants, values).points() - q.points()).norm(), 1e-12);
  }
  // Of values that no curve takes: the residual is orthogonal to all curves.
  const MatrixXd noise = MatrixXd::Random(1, 60);
  const BSpline closest = fit(basis, many, noise);
  const SparseRows B = basis_rows(basis, many, 0).sparse();
  EXPECT_LE(((closest.points() * B.transpose() - noise) * B).norm(), 1e-12);
  EXPECT_THROW(fit(basis, VectorXd::LinSpaced(5, 0, 5), MatrixXd::Zero(3, 5)), std::domain_error);
  EXPECT_THROW(fit(basis, VectorXd::LinSpaced(40, 0, 1), MatrixXd::Zero(3, 40)), std::domain_error);
  EXPECT_THROW(fit(basis, many, MatrixXd::Zero(3, 59)), std::invalid_argument);
}

TEST(BasisMatrix, GrevilleEquationsDetermineEveryControlPoint) {
  // Free control points of a motion from rest to rest, and frames at their abscissae: as many.
  const auto basis = BSplineBasis::clamped_uniform(3, 23, 0, 2);
  const VectorXd frames = basis.greville().segment(3, 17);
  const MatrixXd B = MatrixXd(basis_rows(basis, frames, 0).sparse()).middleCols(3, 17);
  const Eigen::JacobiSVD<MatrixXd> svd(B);
  EXPECT_LT(svd.singularValues()[0] / svd.singularValues()[16], 5);
}

}  // namespace
}  // namespace arboc::test

// Basis values and their derivatives at many instants, as banded and as sparse matrices: what an
// optimiser whose variables are control points multiplies with.
//
//   const arboc::BasisRows B = arboc::basis_rows(basis, instants, 2);   // accelerations
//   P * B.sparse().transpose();   // coordinates x instants
//
// The derivative of any c(q(t_k), q'(t_k), ...) with respect to control point i of coordinate j is
// dc/dq_j B0(k, i) + dc/dq'_j B1(k, i) + ...: blocks of degree + 1 columns a coordinate and
// instant.
#ifndef ARBOC_MOTION_BASIS_MATRIX_HPP
#define ARBOC_MOTION_BASIS_MATRIX_HPP

#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>

#include "bspline.hpp"
#include "quadrature.hpp"

namespace arboc {
inline namespace v1 {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The matrix B (instants x control points) by its band: row k has values.row(k) from column
/// first[k] on, all others are zero.  The pattern depends on the spans of the instants only.
struct BasisRows {
  int columns = 0;
  std::vector<int> first;
  Eigen::MatrixXd values;  ///< instants x (degree + 1)

  /// All degree + 1 entries of each row, those that happen to be zero too, so that one pattern
  /// serves all derivatives.
  SparseRows sparse() const {
    const auto rows = static_cast<Eigen::Index>(first.size());
    SparseRows B(rows, columns);
    B.reserve(Eigen::VectorXi::Constant(rows, static_cast<int>(values.cols())));
    for (Eigen::Index k = 0; k < rows; ++k)
      for (Eigen::Index j = 0; j < values.cols(); ++j)
        B.insert(k, first[static_cast<std::size_t>(k)] + j) = values(k, j);
    B.makeCompressed();
    return B;
  }
};

/// The k-th derivatives of the basis at the instants, in any order.
inline BasisRows basis_rows(const BSplineBasis& basis, const Eigen::VectorXd& instants, int k) {
  BasisRows B{basis.size(), {}, Eigen::MatrixXd(instants.size(), basis.degree() + 1)};
  for (Eigen::Index row = 0; row < instants.size(); ++row) {
    const int s = basis.span(instants[row]);
    B.first.push_back(s - basis.degree());
    B.values.row(row) = basis.derivatives(instants[row], k, s).row(k);
  }
  return B;
}

/// G (control points x control points), banded: the integral over time of f^(k) g^(l) is P G Q^T
/// for curves with control points P and Q; exact.  k = l = 2: the acceleration squared.
inline Eigen::SparseMatrix<double> gram_matrix(const BSplineBasis& basis, int k, int l) {
  const Quadrature rule = span_quadrature(basis, basis.degree() + 1);
  const SparseRows left = basis_rows(basis, rule.instants, k).sparse();
  const SparseRows right = basis_rows(basis, rule.instants, l).sparse();
  const SparseRows G = left.transpose() * rule.weights.asDiagonal() * right;
  return G;
}

/// The curve closest to values (coordinates x instants) in the sense of least squares; through them
/// where there are as many instants as control points, one in each function's support (Greville
/// abscissae are).
inline BSpline fit(const BSplineBasis& basis, const Eigen::VectorXd& instants,
                   const Eigen::MatrixXd& values) {
  if (instants.size() != values.cols())
    throw std::invalid_argument("B-spline: as many values are fitted as instants");
  const Eigen::SparseMatrix<double> B = basis_rows(basis, instants, 0).sparse();
  Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr(B);
  if (qr.info() != Eigen::Success || qr.rank() < basis.size())
    throw std::domain_error("B-spline: the instants do not determine all control points");
  const Eigen::MatrixXd points = qr.solve(Eigen::MatrixXd(values.transpose()));
  return BSpline(basis, points.transpose());
}

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_MOTION_BASIS_MATRIX_HPP

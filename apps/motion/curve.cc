#include "curve.h"

#include <Eigen/LU>

namespace motion {

using arboc::BSplineBasis;
using arboc::nlp::Affine;
using Eigen::MatrixXd;

MatrixXd end_points(const BSplineBasis& basis, const State& state, bool at_end) {
  const MatrixXd all = basis.derivatives(at_end ? basis.end() : basis.begin(), 2);
  const MatrixXd B = at_end ? all.rightCols(3) : all.leftCols(3);
  MatrixXd right(3, state.q.size());
  right << state.q.transpose(), state.v.transpose(), state.a.transpose();
  return B.partialPivLu().solve(right).transpose();
}

Eigen::Matrix3d linked_points(const BSplineBasis& before, const BSplineBasis& next) {
  const Eigen::Matrix3d B = before.derivatives(before.end(), 2).rightCols(3),
                        N = next.derivatives(next.begin(), 2).leftCols(3);
  Eigen::Matrix3d E = N.partialPivLu().solve(B);
  // Values depend on the last point alone, velocities on the last two: the rest is rounding.
  E(0, 0) = E(0, 1) = E(1, 0) = 0;
  E(0, 2) = 1;
  return E;
}

BasisAt basis_at(const BSplineBasis& basis, double t, int order) {
  const int span = basis.span(t);
  return {span - basis.degree(), basis.derivatives(t, order, span)};
}

Affine ControlPoints::operator()(int j, const BasisAt& at, int k) const {
  Affine sum;
  for (Eigen::Index i = 0; i < at.values.cols(); ++i)
    if (at.values(k, i) != 0)
      sum += at.values(k, i) *
             points[static_cast<std::size_t>(j)][static_cast<std::size_t>(at.first + i)];
  return sum;
}

std::vector<Affine> ControlPoints::all(const BasisAt& at, int k) const {
  std::vector<Affine> out;
  for (int j = 0; j < static_cast<int>(points.size()); ++j) out.push_back((*this)(j, at, k));
  return out;
}

MatrixXd values_of(const ControlPoints& points, const std::vector<double>& x) {
  const auto rows = static_cast<Eigen::Index>(points.points.size());
  MatrixXd out(rows, rows > 0 ? static_cast<Eigen::Index>(points.points[0].size()) : 0);
  for (Eigen::Index j = 0; j < out.rows(); ++j)
    for (Eigen::Index i = 0; i < out.cols(); ++i) {
      const Affine& a = points.points[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
      out(j, i) = a.constant;
      for (const Affine::Term& term : a.terms)
        out(j, i) += term.coefficient * x[static_cast<std::size_t>(term.of.index)];
    }
  return out;
}

void set_values(const ControlPoints& points, const MatrixXd& values, std::vector<double>& x) {
  for (Eigen::Index j = 0; j < values.rows(); ++j)
    for (Eigen::Index i = 0; i < values.cols(); ++i) {
      const Affine& a = points.points[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
      if (a.terms.size() == 1 && a.terms[0].coefficient == 1 && a.constant == 0)
        x[static_cast<std::size_t>(a.terms[0].of.index)] = values(j, i);
    }
}

}  // namespace motion

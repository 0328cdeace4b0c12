// Curves q(t) = sum_i N_i(t) P_i of several coordinates, (3.10) of [Thesis].
//
//   const auto basis = arboc::BSplineBasis::clamped_uniform(3, 23, 0, 2);  // degree, points, s
//   arboc::BSpline q(basis, P);           // P: coordinates x 23
//   q(0.7), q(0.7, 1), q(0.7, 2);         // position, velocity, acceleration
//
// A curve stays between the least and the greatest of the control points that it is made of.  Ends
// at rest: the first p control points equal, or the last p.
#ifndef ARBOC_MOTION_BSPLINE_HPP
#define ARBOC_MOTION_BSPLINE_HPP

#include "bspline_basis.hpp"

namespace arboc {
inline namespace v1 {

/// Per coordinate what a curve never falls below or exceeds.
struct CurveBounds {
  Eigen::VectorXd lower, upper;
};

class BSpline {
 public:
  /// `points`: one column a control point, one row a coordinate.
  BSpline(BSplineBasis basis, Eigen::MatrixXd points)
      : basis_(std::move(basis)), points_(std::move(points)) {
    if (points_.cols() != basis_.size())
      throw std::invalid_argument("B-spline: " + std::to_string(points_.cols()) + " points for " +
                                  std::to_string(basis_.size()) + " functions");
  }

  const BSplineBasis& basis() const { return basis_; }
  const Eigen::MatrixXd& points() const { return points_; }

  /// The k-th derivative in time; its derivative with respect to the control points of the span is
  /// basis().derivative(t, k), the same for each coordinate.
  Eigen::VectorXd operator()(double t, int k = 0) const {
    const int p = basis_.degree(), s = basis_.span(t);
    return points_.middleCols(s - p, p + 1) * basis_.derivatives(t, k, s).row(k).transpose();
  }

  /// The k-th derivative as a curve.
  BSpline derivative(int k = 1) const {
    return BSpline(basis_.derived(k), points_ * basis_.derived_points(k).transpose());
  }

  CurveBounds bounds() const { return hull(0, basis_.size()); }
  /// Between two instants: of the control points that play a part there, so the narrower, the
  /// closer to the curve.
  CurveBounds bounds(double from, double to) const {
    if (!(from <= to)) throw std::invalid_argument("B-spline: bounds from later to earlier");
    const int first = basis_.span(from) - basis_.degree();
    return hull(first, basis_.span(to) + 1 - first);
  }

  /// The same curve with one more knot at t, at most degree + 1 in one place; [NURBS] section 5.2.
  BSpline with_knot(double t) const {
    const int p = basis_.degree(), s = basis_.span(t), n = basis_.size();
    std::vector<double> knots = basis_.knots();
    knots.insert(knots.begin() + s + 1, t);
    BSplineBasis finer(p, std::move(knots));
    Eigen::MatrixXd points(points_.rows(), n + 1);
    points.leftCols(s - p + 1) = points_.leftCols(s - p + 1);
    points.rightCols(n - s) = points_.rightCols(n - s);
    for (int i = s - p + 1; i <= s; ++i) {
      const double a = (t - basis_.knot(i)) / (basis_.knot(i + p) - basis_.knot(i));
      points.col(i) = a * points_.col(i) + (1 - a) * points_.col(i - 1);
    }
    return BSpline(std::move(finer), std::move(points));
  }
  /// The same curve with every span halved.
  BSpline refined() const {
    BSpline finer = *this;
    for (const int s : basis_.spans())
      finer = finer.with_knot((basis_.knot(s) + basis_.knot(s + 1)) / 2);
    return finer;
  }

 private:
  CurveBounds hull(int first, int count) const {
    const auto part = points_.middleCols(first, count);
    return {part.rowwise().minCoeff(), part.rowwise().maxCoeff()};
  }

  BSplineBasis basis_;
  Eigen::MatrixXd points_;
};

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_MOTION_BSPLINE_HPP

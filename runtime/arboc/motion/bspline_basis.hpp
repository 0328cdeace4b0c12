// B-spline basis functions: their values and derivatives in time, of any degree and any knots.
//
// A function of time is f(t) = sum_i N_i,p(t) P_i, (3.1) of [Thesis], with n control points P_i and
// n + p + 1 knots u_0 <= ... <= u_{n+p}.  The functions N_i,p of degree p are made by Cox and de
// Boor's recursion (3.3), their derivatives by (3.5) and (3.6).  Because f is linear in the control
// points, N_i,p^(k)(t) is also the derivative of f^(k)(t) with respect to P_i, (3.7)-(3.9).  At an
// instant only p + 1 of them are not zero, those of the span u_s <= t < u_{s+1}: i = s - p ... s.
#ifndef ARBOC_MOTION_BSPLINE_BASIS_HPP
#define ARBOC_MOTION_BSPLINE_BASIS_HPP

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace arboc {
inline namespace v1 {

class BSplineBasis {
 public:
  /// Any knots that do not decrease, of which at most degree + 1 coincide; the first and the last
  /// span between begin() and end() are not empty.
  BSplineBasis(int degree, std::vector<double> knots) : degree_(degree), knots_(std::move(knots)) {
    if (degree_ < 0) throw std::invalid_argument("B-spline: the degree is negative");
    check_knots();
  }

  /// Knots that are equally spaced from begin to end, the ends degree + 1 times each, so that a
  /// curve begins in its first control point and ends in its last.
  static BSplineBasis clamped_uniform(int degree, int control_points, double begin, double end) {
    if (degree < 0 || control_points < degree + 1)
      throw std::invalid_argument("B-spline: degree p needs at least p + 1 control points");
    if (!(begin < end)) throw std::invalid_argument("B-spline: the end is not after the begin");
    const int spans = control_points - degree;
    std::vector<double> knots(static_cast<std::size_t>(degree), begin);
    for (int i = 0; i < spans; ++i) knots.push_back(begin + (end - begin) * i / spans);
    knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, end);
    return BSplineBasis(degree, std::move(knots));
  }

  int degree() const { return degree_; }
  /// Control points.
  int size() const { return static_cast<int>(knots_.size()) - degree_ - 1; }
  const std::vector<double>& knots() const { return knots_; }
  double knot(int i) const { return knots_[static_cast<std::size_t>(i)]; }
  /// Where the functions sum to 1 and curves are defined.
  double begin() const { return knot(degree_); }
  double end() const { return knot(size()); }

  /// The s with u_s <= t < u_{s+1}, of t = end() the last one.  Instants that rounding has put
  /// beyond the ends belong to the first and the last span.
  int span(double t) const {
    const double slack = 1e-12 * (end() - begin());
    if (!(begin() - slack <= t && t <= end() + slack))
      throw std::domain_error("B-spline: " + std::to_string(t) + " is not between " +
                              std::to_string(begin()) + " and " + std::to_string(end()));
    const auto first = knots_.begin() + degree_ + 1, last = knots_.begin() + size();
    return static_cast<int>(std::upper_bound(first, last, t) - knots_.begin()) - 1;
  }

  /// Spans that are not empty, in order.
  std::vector<int> spans() const {
    std::vector<int> found;
    for (int s = degree_; s < size(); ++s)
      if (knot(s) < knot(s + 1)) found.push_back(s);
    return found;
  }

  /// (order + 1) x (degree + 1): in row k the k-th derivatives at t of N_i, i = span(t) - degree
  /// ... span(t).  Rows above the degree are zero.
  Eigen::MatrixXd derivatives(double t, int order) const { return derivatives(t, order, span(t)); }
  /// The same of the polynomials of span s, also beyond it.
  Eigen::MatrixXd derivatives(double t, int order, int s) const {
    if (order < 0) throw std::invalid_argument("B-spline: the order of a derivative is negative");
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(order + 1, degree_ + 1);
    Eigen::RowVectorXd values = Eigen::RowVectorXd::Zero(degree_ + 1);
    values[0] = 1;
    for (int d = 0; d <= degree_; ++d) {  // values of degree d
      if (d > 0) raise(t, s, d, values);
      const int k = degree_ - d;  // derivatives still to take on the way to the full degree
      if (k > order) continue;
      rows.row(k) = values;
      for (int e = d + 1; e <= degree_; ++e) differentiate(s, e, rows.row(k));
    }
    return rows;
  }
  /// 1 x (degree + 1), the k-th derivatives only.
  Eigen::RowVectorXd derivative(double t, int k) const { return derivatives(t, k).row(k); }

  /// The order up to which derivatives of every curve are continuous: degree - 1 unless knots
  /// inside coincide, degree without knots inside; -1 where the curve itself may jump.
  int continuous_derivatives() const {
    int most = 0;
    for (std::size_t i = 0; i < knots_.size(); ++i)
      if (begin() < knots_[i] && knots_[i] < end())
        most = std::max<int>(most,
                             static_cast<int>(std::count(knots_.begin(), knots_.end(), knots_[i])));
    return most == 0 ? degree_ : degree_ - most;
  }

  /// Instants g_i with sum_i g_i N_i(t) = t: as many as control points, increasing, where equations
  /// for a curve may be asked without asking too much of it.  Of clamped knots all lie between
  /// begin() and end().
  Eigen::VectorXd greville() const {
    Eigen::VectorXd g(size());
    for (int i = 0; i < size(); ++i) {
      double sum = 0;
      for (int k = 1; k <= degree_; ++k) sum += knot(i + k);
      g[i] = degree_ > 0 ? sum / degree_ : (knot(i) + knot(i + 1)) / 2;
    }
    return g;
  }

  /// The basis in which k-th derivatives of curves are curves, which may jump at their knots: of
  /// degree - k.
  BSplineBasis derived(int k) const {
    if (k < 0 || k > degree_)
      throw std::invalid_argument("B-spline: a derivative above the degree is zero");
    if (k > continuous_derivatives() + 1)
      throw std::invalid_argument("B-spline: this derivative does not exist where knots coincide");
    return BSplineBasis(degree_ - k, std::vector<double>(knots_.begin() + k, knots_.end() - k));
  }
  /// (size() - k) x size(): the control points of the k-th derivative, of those of the curve.  A
  /// limit on these limits the derivative everywhere.
  Eigen::SparseMatrix<double> derived_points(int k) const {
    derived(k);  // throws
    Eigen::SparseMatrix<double> all(size(), size());
    all.setIdentity();
    for (int d = 0; d < k; ++d) all = (one_derivative(d) * all).eval();
    all.makeCompressed();
    return all;
  }

  /// Integral of N_i over begin() ... end(), of clamped knots.
  double integral(int i) const { return (knot(i + degree_ + 1) - knot(i)) / (degree_ + 1); }

 private:
  void check_knots() const {
    if (knots_.size() < 2 * static_cast<std::size_t>(degree_) + 2)
      throw std::invalid_argument("B-spline: degree p needs at least 2 p + 2 knots");
    const std::size_t p = static_cast<std::size_t>(degree_);
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i)
      if (!(knots_[i] <= knots_[i + 1]))
        throw std::invalid_argument("B-spline: knot " + std::to_string(i + 1) + " decreases");
    for (std::size_t i = 0; i + p + 1 < knots_.size(); ++i)
      if (knots_[i] == knots_[i + p + 1])
        throw std::invalid_argument("B-spline: more than degree + 1 knots coincide");
    if (!(begin() < knot(degree_ + 1)) || !(knot(size() - 1) < end()))
      throw std::invalid_argument("B-spline: the first or the last span is empty");
  }

  /// (3.3): in place of the d values of degree d - 1 that are not zero on span s, the d + 1 ones of
  /// degree d.  No denominator is zero, as each covers the span.
  void raise(double t, int s, int d, Eigen::RowVectorXd& w) const {
    for (int j = d; j >= 0; --j) {
      const int i = s - d + j;
      const double left = j > 0 ? (t - knot(i)) / (knot(i + d) - knot(i)) * w[j - 1] : 0;
      const double right =
          j < d ? (knot(i + d + 1) - t) / (knot(i + d + 1) - knot(i + 1)) * w[j] : 0;
      w[j] = left + right;
    }
  }
  /// (3.5): likewise to the derivatives of degree d.
  template <class Row>
  void differentiate(int s, int d, Row&& w) const {
    for (int j = d; j >= 0; --j) {
      const int i = s - d + j;
      const double left = j > 0 ? w[j - 1] / (knot(i + d) - knot(i)) : 0;
      const double right = j < d ? w[j] / (knot(i + d + 1) - knot(i + 1)) : 0;
      w[j] = d * (left - right);
    }
  }
  /// From the d-th derivative's control points to those of the next one.
  Eigen::SparseMatrix<double> one_derivative(int d) const {
    const int n = size() - d, p = degree_ - d;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i + 1 < n; ++i) {
      const double width = knot(d + i + p + 1) - knot(d + i + 1);
      if (width == 0) continue;  // of a function that is zero everywhere
      entries.emplace_back(i, i, -p / width);
      entries.emplace_back(i, i + 1, p / width);
    }
    Eigen::SparseMatrix<double> D(n - 1, n);
    D.setFromTriplets(entries.begin(), entries.end());
    return D;
  }

  int degree_;
  std::vector<double> knots_;
};

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_MOTION_BSPLINE_BASIS_HPP

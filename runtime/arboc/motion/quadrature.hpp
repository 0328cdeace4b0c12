// Gauss-Legendre points: integrals over time that are exact for polynomials.
//
// m points integrate degrees up to 2 m - 1.  On each span of a B-spline a curve is a polynomial, so
// points a span make integrals of products of curves exact, and those of other functions of curves
// as accurate as polynomials approximate them.
#ifndef ARBOC_MOTION_QUADRATURE_HPP
#define ARBOC_MOTION_QUADRATURE_HPP

#include <cmath>

#include "bspline_basis.hpp"

namespace arboc {
inline namespace v1 {

/// Integral of f is about sum_k weights[k] f(instants[k]).
struct Quadrature {
  Eigen::VectorXd instants;  ///< increasing
  Eigen::VectorXd weights;   ///< positive; s, as instants
};

/// m points between -1 and 1: the roots of the Legendre polynomial P_m, by Newton's method.
inline Quadrature gauss_legendre(int m) {
  if (m < 1) throw std::invalid_argument("quadrature: there is no rule without points");
  constexpr double kPi = 3.141592653589793;
  Quadrature rule{Eigen::VectorXd(m), Eigen::VectorXd(m)};
  for (int k = 0; k < m; ++k) {
    double x = -std::cos(kPi * (k + 0.75) / (m + 0.5)), slope = 0;
    for (int step = 0; step < 10; ++step) {
      double before = 1, value = x;  // P_0, P_1
      for (int n = 2; n <= m; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
      }
      slope = m * (before - x * value) / ((1 - x) * (1 + x));
      x -= value / slope;
    }
    rule.instants[k] = x;
    rule.weights[k] = 2 / ((1 - x) * (1 + x) * slope * slope);
  }
  return rule;
}

/// m points on every span that is not empty.
inline Quadrature span_quadrature(const BSplineBasis& basis, int m) {
  const Quadrature rule = gauss_legendre(m);
  const std::vector<int> spans = basis.spans();
  const auto count = static_cast<Eigen::Index>(spans.size());
  Quadrature all{Eigen::VectorXd(count * m), Eigen::VectorXd(count * m)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const double a = basis.knot(spans[static_cast<std::size_t>(k)]);
    const double b = basis.knot(spans[static_cast<std::size_t>(k)] + 1);
    all.instants.segment(k * m, m) = ((a + b) / 2 + (b - a) / 2 * rule.instants.array()).matrix();
    all.weights.segment(k * m, m) = (b - a) / 2 * rule.weights;
  }
  return all;
}

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_MOTION_QUADRATURE_HPP

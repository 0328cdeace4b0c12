// Functions of a scalar that is a double or, for derivatives by complex step, a complex number
// whose imaginary part is a step far below rounding.
#pragma once
#include <cmath>
#include <complex>

#include "base/exact_trig.h"

namespace arboc {
using Complex = std::complex<double>;
}

namespace arboc::scalar {

template <class S>
struct SinCosOf {
  S sin, cos;
};

/// The same bits on every machine where exact_sincos reaches: results are recorded for selftests.
inline SinCosOf<double> sincos(double x) {
  if (!(std::fabs(x) < 1e9)) return {std::sin(x), std::cos(x)};
  const SinCos at = exact_sincos(x);
  return {at.sin, at.cos};
}

inline SinCosOf<Complex> sincos(const Complex& x) {
  const auto [s, c] = sincos(x.real());
  const double ch = std::cosh(x.imag()), sh = std::sinh(x.imag());
  return {{s * ch, c * sh}, {c * ch, -s * sh}};
}

inline double real_part(double x) { return x; }
inline double real_part(const Complex& x) { return x.real(); }

/// The angle of (x, y); of complex ones to first order in the imaginary parts.
inline double angle_of(double y, double x) { return std::atan2(y, x); }
inline Complex angle_of(const Complex& y, const Complex& x) {
  const double a = x.real(), b = y.real();
  return {std::atan2(b, a), (a * y.imag() - b * x.imag()) / (a * a + b * b)};
}

// Even functions of an angle x, of its square xx: so they have no kink at 0.  Series where the
// closed form would cancel; their first term left out is below 1e-17.
constexpr double kSeries = 0.01;

/// cos x.
template <class S>
S cosine(const S& xx) {
  return sincos(S(std::sqrt(xx))).cos;
}

/// sin x / x.
template <class S>
S sinc(const S& xx) {
  if (std::abs(xx) < kSeries)
    return 1. - xx / 6. * (1. - xx / 20. * (1. - xx / 42. * (1. - xx / 72.)));
  const S x = std::sqrt(xx);
  return sincos(x).sin / x;
}

/// (1 - cos x) / x^2.
template <class S>
S versine(const S& xx) {
  const S half = sinc(S(xx / 4.));
  return half * half / 2.;
}

/// (x - sin x) / x^3.
template <class S>
S third(const S& xx) {
  if (std::abs(xx) < kSeries)
    return (1. - xx / 20. * (1. - xx / 42. * (1. - xx / 72. * (1. - xx / 110.)))) / 6.;
  return (1. - sinc(xx)) / xx;
}

/// (1 - x/2 cot(x/2)) / x^2.
template <class S>
S cotangent_rest(const S& xx) {
  if (std::abs(xx) < kSeries)
    return 1. / 12 + xx / 720. * (1. + xx / 42. * (1. + xx / 40. * (1. + xx * 10. / 396.)));
  const S quarter = xx / 4.;
  return (1. - cosine(quarter) / sinc(quarter)) / xx;
}

/// atan2(n, s) / n of n^2, for s > 0.
template <class S>
S angle_ratio(const S& nn, const S& s) {
  const S t = nn / (s * s);
  if (std::abs(t) >= kSeries) {
    const S n = std::sqrt(nn);
    return angle_of(n, s) / n;
  }
  S sum = 0.;
  for (int k = 8; k >= 0; --k) sum = 1. / (2 * k + 1) - t * sum;
  return sum / s;
}

}  // namespace arboc::scalar

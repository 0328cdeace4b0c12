// Smooth stand-ins for absolute values and for switches of sign, with their derivatives.
//
//   |x|             sqrt(x^2 + e^2)            at most e above, where x = 0
//   1 if x >= 0     (1 + x / sqrt(x^2 + e^2))/2
//
// On any scalar with + - * / and sqrt, such as std::complex for complex steps.
#ifndef ARBOC_MEASURES_SMOOTH_HPP
#define ARBOC_MEASURES_SMOOTH_HPP

#include <cmath>

namespace arboc {
inline namespace v1 {

/// A function of one variable and its first and second derivative.
template <class T>
struct Jet1 {
  T value, d, dd;
};

template <class T>
Jet1<T> smooth_abs(const T& x, double e) {
  using std::sqrt;
  const T r = sqrt(x * x + e * e);
  return {r, x / r, e * e / (r * r * r)};
}

template <class T>
Jet1<T> smooth_step(const T& x, double e) {
  using std::sqrt;
  const T r = sqrt(x * x + e * e), slope = 0.5 * e * e / (r * r * r);
  return {0.5 * (1.0 + x / r), slope, -3.0 * slope * x / (r * r)};
}

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_MEASURES_SMOOTH_HPP

// Numbers with a derivative: an algorithm run on them returns that of its results, to rounding.
#pragma once
#include <cmath>
#include <string>

namespace arboc::test {

struct Dual {
  double x = 0, d = 0;

  Dual() = default;
  Dual(double value) : x(value) {}  // NOLINT: constants of the model enter expressions
  Dual(double value, double derivative) : x(value), d(derivative) {}

  Dual operator-() const { return {-x, -d}; }
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.x + b.x, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.x - b.x, a.d - b.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.x * b.x, a.d * b.x + a.x * b.d}; }
};

inline Dual operator/(const Dual& a, const Dual& b) {
  return {a.x / b.x, (a.d - a.x / b.x * b.d) / b.x};
}
inline Dual sqrt(const Dual& a) {
  const double root = std::sqrt(a.x);
  return {root, a.d / (2 * root)};
}

inline void sincos(const Dual& angle, Dual& s, Dual& c) {
  const double sine = std::sin(angle.x), cosine = std::cos(angle.x);
  s = {sine, cosine * angle.d};
  c = {cosine, -sine * angle.d};
}

inline void enter_block(const Dual* /*inputs*/, const std::string& /*link*/,
                        const char* /*phase*/) {}

}  // namespace arboc::test

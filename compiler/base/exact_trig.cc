#include "base/exact_trig.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace arboc {
namespace {

/// An unevaluated sum hi + lo with |lo| <= ulp(hi) / 2: about 106 bits.
struct DoubleDouble {
  double hi = 0.0;
  double lo = 0.0;
};

DoubleDouble two_sum(double a, double b) {
  const double s = a + b;
  const double t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}
DoubleDouble quick_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}
DoubleDouble two_product(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}
DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble s = two_sum(a.hi, b.hi);
  const DoubleDouble t = two_sum(a.lo, b.lo);
  const DoubleDouble u = quick_two_sum(s.hi, s.lo + t.hi);
  return quick_two_sum(u.hi, u.lo + t.lo);
}
DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_product(a.hi, b.hi);
  return quick_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}
DoubleDouble operator/(DoubleDouble a, double b) {
  const double q = a.hi / b;
  const DoubleDouble p = two_product(q, b);
  return quick_two_sum(q, ((a.hi - p.hi) - p.lo + a.lo) / b);
}
DoubleDouble operator-(DoubleDouble a) { return {-a.hi, -a.lo}; }

/// pi/2 = the sum of these, to 160 bits.
constexpr std::array<double, 3> kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54,
                                           -0x1.f1976b7ed8fbcp-110};

/// angle - k pi/2.
DoubleDouble reduce(double angle, double k) {
  DoubleDouble r{angle, 0.0};
  for (const double part : kHalfPi) r = r + -two_product(k, part);
  return r;
}

/// Taylor series about 0 for |x| <= pi/4; 15 terms leave 1e-33.
DoubleDouble series(DoubleDouble first, DoubleDouble x2, int next) {
  DoubleDouble term = first, sum = first;
  for (int i = 0; i < 15; ++i, next += 2) {
    term = -(term * x2) / (static_cast<double>(next) * (next + 1));
    sum = sum + term;
  }
  return sum;
}

SinCos quarter_turns(SinCos r, long k) {
  switch (k & 3) {
    case 0: return r;
    case 1: return {r.cos, -r.sin};
    case 2: return {-r.sin, -r.cos};
    default: return {-r.cos, r.sin};
  }
}

}  // namespace

double degrees15(long k) {
  const DoubleDouble product =
      DoubleDouble{kHalfPi[0], kHalfPi[1]} * DoubleDouble{static_cast<double>(k), 0.0};
  return (product / 6.0).hi;
}

std::optional<long> multiple_of_15_degrees(double angle, double tolerance) {
  const double k = std::nearbyint(angle / kHalfPi[0] * 6.0);
  if (std::fabs(k) > 1e9) return std::nullopt;
  if (std::fabs(angle - degrees15(static_cast<long>(k))) > tolerance) return std::nullopt;
  return static_cast<long>(k);
}

namespace {

SinCos computed_sincos(double angle) {
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  if (const auto k = multiple_of_15_degrees(angle, kRounding * std::fabs(angle))) {
    const long quarter = std::lround(static_cast<double>(*k) / 6.0);
    const long rest = *k - 6 * quarter;  // -3..3, times 15 degrees
    // Correctly rounded sines of 15, 30, 45 degrees and of their complements.
    constexpr std::array<double, 4> kSin = {0.0, 0.25881904510252074, 0.5, 0.7071067811865476};
    constexpr std::array<double, 4> kCos = {1.0, 0.9659258262890683, 0.8660254037844386,
                                            0.7071067811865476};
    const auto n = static_cast<size_t>(std::labs(rest));
    return quarter_turns({rest < 0 ? -kSin[n] : kSin[n], kCos[n]}, quarter);
  }
  const double k = std::nearbyint(angle / kHalfPi[0]);
  const DoubleDouble x = reduce(angle, k);
  const DoubleDouble x2 = x * x;
  const DoubleDouble sine = series(x, x2, 2);
  const DoubleDouble cosine = series({1.0, 0.0}, x2, 1);
  return quarter_turns({sine.hi, cosine.hi}, static_cast<long>(k));
}

}  // namespace

SinCos exact_sincos(double angle) {
  struct Known {
    std::uint64_t bits = 0;
    SinCos value;  ///< at first of 0
  };
  constexpr unsigned kSlots = 1024;
  thread_local std::array<Known, kSlots> table{};
  const auto bits = std::bit_cast<std::uint64_t>(angle);
  Known& known = table[(bits * 0x9E3779B97F4A7C15u) >> 54];
  if (known.bits != bits) known = {bits, computed_sincos(angle)};
  return known.value;
}

}  // namespace arboc

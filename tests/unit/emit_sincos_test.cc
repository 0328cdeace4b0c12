// Accuracy of arboc::sincos (runtime/arboc/scalar.hpp), with and without the branch-free version,
// against long double, which carries at least 11 bits more.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/random.h"
#include "unit/sincos_builds.h"

namespace arboc::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Error of `got` in units of the last place of `exact`.
double ulps(double got, long double exact) {
  int exponent = 0;
  std::frexp(static_cast<double>(exact), &exponent);
  const long double ulp = std::ldexp(1.0L, std::max(exponent - 53, -1074));
  return static_cast<double>(std::fabs(static_cast<long double>(got) - exact) / ulp);
}

class Sincos : public testing::TestWithParam<SincosBuild> {
 protected:
  void SetUp() override {
    if (!GetParam().runs()) GTEST_SKIP() << "this machine has no fused multiply-add";
  }
  /// Larger error of the two.
  double error(double x) const {
    double s = 0, c = 0;
    GetParam().sincos(x, s, c);
    const long double exact = x;
    return std::max(ulps(s, std::sin(exact)), ulps(c, std::cos(exact)));
  }
  void expect_at_most(double bound, double x) const { EXPECT_LE(error(x), bound) << x; }
};

// One ulp is what the header promises below 1e5; beyond it hands over to the C library, which
// stays well below 2.5.
TEST_P(Sincos, RandomAngles) {
  Random random(1);
  for (const double range : {0.01, 1.0, 4.0, 100.0, 1e4, 1e5})
    for (int k = 0; k < 20000; ++k) expect_at_most(1, random.uniform(-range, range));
}

TEST_P(Sincos, TinyAngles) {
  for (int e = -1074; e < -20; ++e) {
    expect_at_most(1, std::ldexp(1.0, e));
    expect_at_most(1, -std::ldexp(1.5, e));
  }
}

TEST_P(Sincos, NearMultiplesOfHalfPi) {
  const long double half_pi = std::acos(-1.0L) / 2;
  for (int n = -63600; n <= 63600; n += n > -200 && n < 200 ? 1 : 53) {
    double x = static_cast<double>(n * half_pi);
    double low = x, high = x;
    for (int step = 0; step < 3; ++step) {
      expect_at_most(1, low);
      expect_at_most(1, high);
      low = std::nextafter(low, -kInfinity);
      high = std::nextafter(high, kInfinity);
    }
    // Where the quadrant changes.
    expect_at_most(1, static_cast<double>((n + 0.5L) * half_pi));
  }
}

TEST_P(Sincos, LargeAngles) {
  Random random(2);
  for (double range = 1e5; range <= 1e15; range *= 10)
    for (int k = 0; k < 2000; ++k) expect_at_most(2.5, random.uniform(-range, range));
  for (const double x : {99999.99, 1e5, 100000.01, 1e15, -1e15}) expect_at_most(2.5, x);
}

TEST_P(Sincos, Zero) {
  double s = 1, c = 0;
  GetParam().sincos(0.0, s, c);
  EXPECT_EQ(s, 0);
  EXPECT_FALSE(std::signbit(s));
  EXPECT_EQ(c, 1);
  GetParam().sincos(-0.0, s, c);
  EXPECT_EQ(s, 0);
  EXPECT_TRUE(std::signbit(s));
  EXPECT_EQ(c, 1);
}

TEST_P(Sincos, NotFinite) {
  for (const double x : {kInfinity, -kInfinity, std::nan("")}) {
    double s = 0, c = 0;
    GetParam().sincos(x, s, c);
    EXPECT_TRUE(std::isnan(s)) << x;
    EXPECT_TRUE(std::isnan(c)) << x;
  }
}

TEST_P(Sincos, IsOddAndEven) {
  Random random(3);
  for (int k = 0; k < 10000; ++k) {
    const double x = random.uniform(-1e5, 1e5);
    double s = 0, c = 0, s_minus = 0, c_minus = 0;
    GetParam().sincos(x, s, c);
    GetParam().sincos(-x, s_minus, c_minus);
    EXPECT_EQ(s, -s_minus) << x;
    EXPECT_EQ(c, c_minus) << x;
  }
}

INSTANTIATE_TEST_SUITE_P(Builds, Sincos, testing::ValuesIn(kSincosBuilds),
                         [](const auto& at) { return std::string(at.param.name); });

}  // namespace
}  // namespace arboc::test

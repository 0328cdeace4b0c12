// arboc/angles.hpp: sines and cosines of one to four angles at a time, of every kind of scalar.
#include "arboc/angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/random.h"

namespace arboc::test {
namespace {

/// Sines, then cosines, of the first n of four angles; the places behind stay 7 or are anything.
template <class T>
void sincos_of(int n, const T (&x)[4], T (&out)[8]) {
  for (T& y : out) y = T(7);
  const Angles<T> one(x[0]), two(x[0], x[1]), three(x[0], x[1], x[2]), four(x[0], x[1], x[2], x[3]);
  const Angles<T>* const all[] = {&one, &two, &three, &four};
  all[n - 1]->sincos_to(out, out + 4);
}

/// One ulp is what both versions promise; next to it the library's own error.
template <class T>
void expect_sincos(double range) {
  Random random(5);
  for (int k = 0; k < 1000; ++k) {
    T x[4], out[8];
    for (T& angle : x) angle = static_cast<T>(random.uniform(-range, range));
    for (int n = 1; n <= 4; ++n) {
      sincos_of(n, x, out);
      for (int i = 0; i < n; ++i) {
        const T sine = out[i] - std::sin(x[i]), cosine = out[4 + i] - std::cos(x[i]);
        EXPECT_LE(std::abs(sine), 2 * std::numeric_limits<T>::epsilon()) << x[i];
        EXPECT_LE(std::abs(cosine), 2 * std::numeric_limits<T>::epsilon()) << x[i];
      }
    }
  }
}

TEST(Angles, OfAllScalars) {
  for (const double range : {1.0, 1e3, 1e6}) {
    expect_sincos<double>(range);
    expect_sincos<float>(range);
    expect_sincos<long double>(range);
  }
}

TEST(Angles, OfPacksAreOneByOne) {
  using P = Pack<double, 2>;
  const P x[4] = {P(0.1), P(0.2), P(0.3), P(0.4)};
  P out[8];
  sincos_of(3, x, out);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(out[i][1], std::sin(0.1 * (i + 1)), 1e-15);
  EXPECT_EQ(out[3][0], 7);  // not asked for, not computed
}

/// Whatever this translation unit may use: others allocate what it computes on.
TEST(Angles, PacksAreAlignedAsTheirVectors) {
  static_assert(alignof(Pack<double, 2>) == 16 && alignof(Pack<double, 4>) == 32);
  static_assert(alignof(Pack<double, 8>) == 64 && alignof(Pack<float, 16>) == 64);
  const std::vector<Pack<double, 8>> heap(3);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(heap.data()) % 64, 0u);
}

TEST(Angles, NotFiniteStaysInItsPlace) {
  const double x[4] = {1, std::numeric_limits<double>::infinity(), std::nan(""), 2};
  double out[8];
  sincos_of(4, x, out);
  EXPECT_NEAR(out[0], std::sin(1.0), 1e-15);
  EXPECT_TRUE(std::isnan(out[1]) && std::isnan(out[5]));
  EXPECT_TRUE(std::isnan(out[2]) && std::isnan(out[6]));
  EXPECT_NEAR(out[7], std::cos(2.0), 1e-15);
}

}  // namespace
}  // namespace arboc::test

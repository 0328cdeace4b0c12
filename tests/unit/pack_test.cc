// Packs: arithmetic, functions of rotations, statuses and arrays of states, lane by lane.
#include "unit/pack_test.h"

#include "arboc/scalar.hpp"

namespace arboc::test {
namespace {

template <class S>
class Packs : public testing::TestWithParam<PackCase<S>> {
 protected:
  using Values = std::vector<S>;
  static constexpr S kUnit = std::numeric_limits<S>::epsilon() / 2;
  static constexpr size_t n = 4000;

  const PackFunctions<S>& f() const { return this->GetParam().functions(); }
  int lanes() const { return this->GetParam().lanes; }
  static Values random(std::uint64_t seed, double low, double high) {
    Random source(seed);
    Values x;
    for (size_t k = 0; k < n; ++k) x.push_back(static_cast<S>(source.uniform(low, high)));
    return x;
  }

  /// As the machine's arithmetic; where a product may be fused into a sum, half an ulp of it apart.
  void arithmetic() const {
    const Values x = random(1, -2, 2), y = random(2, -2, 2);
    Values z(6 * n);
    f().arithmetic(lanes(), x, y, z);
    for (size_t k = 0; k < n; ++k) {
      EXPECT_EQ(z[k], x[k] + 2 * y[k]);
      EXPECT_EQ(z[n + k], x[k] - y[k] / 3);
      EXPECT_EQ(z[2 * n + k], -x[k] * y[k]);
      EXPECT_EQ(z[3 * n + k], std::sqrt(std::fabs(x[k])));
      EXPECT_EQ(z[4 * n + k], std::min(x[k], y[k]));
      bool any = false;
      const size_t width = static_cast<size_t>(lanes());
      for (size_t i = k / width * width; i < (k / width + 1) * width; ++i) any = any || x[i] < -1;
      EXPECT_EQ(z[5 * n + k], any);
    }
  }

  /// A few units of the last place, as scalars; beyond the first zero of the size of the
  /// oscillation.  c_4 and c_5 amplify them in each step of their recursion.
  void stumpff() const {
    for (const double range : {1e-6, 1.0, 12.0, 40.0, 1000.0}) {
      const Values x = random(3, 0, range);
      Values y(6 * n);
      f().stumpff(lanes(), x, y);
      for (size_t k = 0; k < n; ++k) {
        const double at = x[k];
        const double exact[] = {arboc::stumpff<0>(at), arboc::stumpff<1>(at),
                                arboc::stumpff<2>(at), arboc::stumpff<3>(at),
                                arboc::stumpff<4>(at), arboc::stumpff<5>(at)};
        for (size_t c = 0; c < 6; ++c) {
          const double scale = std::max(
              std::fabs(exact[c]), c < 3 ? std::pow(1 + std::sqrt(at), -static_cast<int>(c)) : 0);
          // The square root's rounding turns the angle by sqrt(x) half ulps.
          EXPECT_LE(std::fabs(y[c * n + k] - exact[c]) / scale, (30 + 2 * std::sqrt(at)) * kUnit)
              << "c_" << c << " of " << at;
        }
      }
    }
  }

  void logarithm() const {
    Values w = random(4, -1, 1);
    for (size_t k = 0; k < 200; ++k)  // close to 1, and both signs of 0
      w[k] = static_cast<S>((k % 2 ? -1 : 1) * (1 - std::ldexp(1.0, -static_cast<int>(k) / 4)));
    Values y(2 * n);
    f().logarithm(lanes(), w, y);
    for (size_t k = 0; k < n; ++k) {
      const double at = w[k];
      EXPECT_LE(std::fabs(y[k] / arboc::quaternion_log(at) - 1), 16 * kUnit) << at;
      EXPECT_LE(std::fabs(y[n + k] / arboc::log_curvature(at) - 1), 32 * kUnit) << at;
    }
  }

  void rows() const {
    const auto copies = [this](int entries, int stride, size_t states) {
      const size_t size = static_cast<size_t>(stride) * states;
      Values from(size), to(size, -7);
      for (size_t k = 0; k < size; ++k) from[k] = static_cast<S>(k + 1);
      f().copy(lanes(), from, entries, stride, to);
      for (size_t k = 0; k < size; ++k)
        if (to[k] !=
            (k % static_cast<size_t>(stride) < static_cast<size_t>(entries) ? from[k] : -7))
          return false;
      return true;
    };
    for (int entries = 0; entries < 40; ++entries)
      for (size_t states = 1; states < 36; states += 1 + states / 5)
        for (const int extra : {1, 3})
          EXPECT_TRUE(copies(entries, entries + extra, states)) << entries << " x " << states;
  }

  /// Lanes where a value of the column is not positive, not a number included.
  void checks() const {
    constexpr int rows = 3;
    constexpr size_t states = 64;
    const Values values(states, 5);
    Values columns(rows * states, 1), got = values;
    columns[7] = 0;                                       // row 0, state 7
    columns[states + 7] = columns[2 * states + 20] = -1;  // rows 1 and 2
    columns[states + 33] = std::numeric_limits<S>::quiet_NaN();
    std::vector<int> status(states, -1);
    f().checked(lanes(), columns, rows, status, got);
    for (size_t k = 0; k < states; ++k) {
      const int expected = k == 7 ? 1 : k == 20 ? 3 : k == 33 ? 2 : 0;
      EXPECT_EQ(status[k], expected) << k;
      if (expected == 0)
        EXPECT_EQ(got[k], 5);
      else
        EXPECT_TRUE(std::isnan(got[k])) << k;
    }
  }

  void all() const {
    arithmetic();
    stumpff();
    logarithm();
    rows();
    checks();
  }
};

using PacksOfDouble = Packs<double>;
using PacksOfFloat = Packs<float>;
TEST_P(PacksOfDouble, EqualScalars) { all(); }
TEST_P(PacksOfFloat, EqualScalars) { all(); }
INSTANTIATE_TEST_SUITE_P(Builds, PacksOfDouble, testing::ValuesIn(pack_cases<double>()),
                         case_name<double>);
INSTANTIATE_TEST_SUITE_P(Builds, PacksOfFloat, testing::ValuesIn(pack_cases<float>()),
                         case_name<float>);

}  // namespace
}  // namespace arboc::test

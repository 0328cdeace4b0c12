// The functions of pack_builds.h, for flags of one's own: in the namespace ARBOC_BUILD, since two
// builds of one inline function would be merged by the linker.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "unit/pack_builds.h"

namespace ARBOC_BUILD {
#include "arboc/rows.hpp"

using arboc::Pack;

/// Calls f(x, k) for packs x of `values` from k on.
template <int N, class S, class F>
void for_packs(const std::vector<S>& values, const F& f) {
  for (std::size_t k = 0; k + N <= values.size(); k += N) {
    Pack<S, N> x;
    std::memcpy(&x, &values[k], sizeof x);
    f(x, k);
  }
}

template <class S, int N>
struct Functions {
  using P = Pack<S, N>;
  using Values = std::vector<S>;

  static void put(const P& x, S* to) { std::memcpy(to, &x, sizeof x); }

  static void sincos(const Values& x, Values& sine, Values& cosine) {
    for_packs<N>(x, [&](const P& a, std::size_t k) {
      P s, c;
      arboc::sincos(a, s, c);
      put(s, &sine[k]);
      put(c, &cosine[k]);
    });
  }
  static void stumpff(const Values& x, Values& y) {
    const std::size_t n = x.size();
    for_packs<N>(x, [&](const P& a, std::size_t k) {
      put(arboc::stumpff<0>(a), &y[k]);
      put(arboc::stumpff<1>(a), &y[n + k]);
      put(arboc::stumpff<2>(a), &y[2 * n + k]);
      put(arboc::stumpff<3>(a), &y[3 * n + k]);
      put(arboc::stumpff<4>(a), &y[4 * n + k]);
      put(arboc::stumpff<5>(a), &y[5 * n + k]);
    });
  }
  static void logarithm(const Values& w, Values& y) {
    for_packs<N>(w, [&](const P& a, std::size_t k) {
      put(arboc::quaternion_log(a), &y[k]);
      put(arboc::log_curvature(a), &y[w.size() + k]);
    });
  }
  static void arithmetic(const Values& x, const Values& y, Values& z) {
    const std::size_t n = x.size();
    for_packs<N>(x, [&](const P& a, std::size_t k) {
      P b;
      std::memcpy(&b, &y[k], sizeof b);
      put(a + P(2) * b, &z[k]);
      put(a - b / P(3), &z[n + k]);
      put(-a * b, &z[2 * n + k]);
      put(sqrt(fabs(a)), &z[3 * n + k]);
      put(select(b > a, a, b), &z[4 * n + k]);
      put(P(any(a < P(-1))), &z[5 * n + k]);
    });
  }
  static void copy(const Values& from, int entries, int stride, Values& to) {
    const std::size_t n = from.size() / static_cast<std::size_t>(stride);
    std::vector<P> packs(static_cast<std::size_t>(entries));
    const arboc::Rows<const S> source(from.data(), stride);
    for (std::size_t first = 0; first < n; first += N) {
      arboc::load(source, entries, first, n, packs.data());
      arboc::store(packs.data(), entries, first, n, arboc::Rows<S>(to.data(), stride));
    }
  }
  static void checked(const Values& columns, int n, std::vector<int>& status, Values& values) {
    const std::size_t states = values.size();
    std::vector<P> x(static_cast<std::size_t>(n));
    for_packs<N>(values, [&](P a, std::size_t k) {
      for (std::size_t i = 0; i < x.size(); ++i)
        std::memcpy(&x[i], &columns[i * states + k], sizeof a);
      const auto found = arboc::check_positive(x.data(), n);
      arboc::fill_nan(found, &a, 1);
      for (int lane = 0; lane < N; ++lane) status[k + static_cast<std::size_t>(lane)] = found[lane];
      put(a, &values[k]);
    });
  }
};

template <class S>
struct Choice {
  template <class F>
  static void of(int lanes, const F& f) {
    if (lanes == 2) f(Functions<S, 2>());
    if (lanes == 4) f(Functions<S, 4>());
    if (lanes == 8) f(Functions<S, 8>());
    if (lanes == 16) f(Functions<S, 16>());
  }
  using Values = std::vector<S>;
  static constexpr ::arboc::test::PackFunctions<S> functions() {
    return {[](int n, const Values& x, Values& s, Values& c) {
              of(n, [&](auto f) { f.sincos(x, s, c); });
            },
            [](int n, const Values& x, Values& y) { of(n, [&](auto f) { f.stumpff(x, y); }); },
            [](int n, const Values& w, Values& y) { of(n, [&](auto f) { f.logarithm(w, y); }); },
            [](int n, const Values& x, const Values& y, Values& z) {
              of(n, [&](auto f) { f.arithmetic(x, y, z); });
            },
            [](int n, const Values& from, int entries, int stride, Values& to) {
              of(n, [&](auto f) { f.copy(from, entries, stride, to); });
            },
            [](int n, const Values& x, int rows, std::vector<int>& status, Values& y) {
              of(n, [&](auto f) { f.checked(x, rows, status, y); });
            }};
  }
};

}  // namespace ARBOC_BUILD

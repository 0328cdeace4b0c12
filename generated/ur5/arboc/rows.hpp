// Arrays of states, one state a row, into packs and back.
#ifndef ARBOC_ROWS_HPP
#define ARBOC_ROWS_HPP

#include <cstddef>
#include <cstring>
#include <utility>

#include "pack.hpp"

namespace arboc {
inline namespace v1 {

/// An argument at many states: entry i of state s is data[s * stride + i].  Without a stride rows
/// lie one behind the other; with 0 all states have the same.
template <class S>
struct Rows {
  static constexpr std::ptrdiff_t kDense = -1;
  S* data;
  std::ptrdiff_t stride;

  // NOLINTNEXTLINE(google-explicit-constructor): an array is what one has.
  Rows(S* array, std::ptrdiff_t step = kDense) : data(array), stride(step) {}
  S* row(std::size_t s, int entries) const {
    return data + static_cast<std::ptrdiff_t>(s) * (stride == kDense ? entries : stride);
  }
};

namespace detail {

/// a0 b0 a1 b1 ... of the lower (half 0) or the upper halves of a and b.
template <int half, class S, int N, int... I>
ARBOC_INLINE Pack<S, N> zip(const Pack<S, N>& a, const Pack<S, N>& b,
                            std::integer_sequence<int, I...>) {
#if defined(__clang__)
  return Pack<S, N>(__builtin_shufflevector(a.v, b.v, ((I % 2) * N + half * (N / 2) + I / 2)...));
#else
  typedef typename Bits<S>::Signed Index __attribute__((vector_size(sizeof(a))));
  return Pack<S, N>(__builtin_shuffle(a.v, b.v, Index{((I % 2) * N + half * (N / 2) + I / 2)...}));
#endif
}

/// N rows become N columns: log2 N times rows i and i + N / 2 are zipped into 2 i and 2 i + 1.
template <int steps, class S, int N, int... I>
ARBOC_INLINE void transpose(Pack<S, N> (&x)[N], std::integer_sequence<int, I...> all) {
  const Pack<S, N> y[N] = {zip<I % 2>(x[I / 2], x[I / 2 + N / 2], all)...};
  ((x[I] = y[I]), ...);
  if constexpr (steps > 2) transpose<steps / 2>(x, all);
}

/// M rows from the address `from(k)` of row k become M columns at `to(k)`.  (Written without loops:
/// compilers keep what they unroll late in memory.)
template <class S, int M, class From, class To, int... I>
ARBOC_INLINE void transpose(const From& from, const To& to, std::integer_sequence<int, I...> all) {
  Pack<S, M> x[M];
  (std::memcpy(&x[I], from(I), sizeof x[I]), ...);
  transpose<M>(x, all);
  (std::memcpy(to(I), &x[I], sizeof x[I]), ...);
}

/// Calls square(i, lane) for squares of M entries and lanes, the last one overlapping the one
/// before.
template <int M, int N, class Square>
ARBOC_INLINE void squares(int entries, const Square& square) {
  for (int begin = 0; begin < entries; begin += M)
    for (int lane = 0; lane < N; lane += M)
      square(begin + M <= entries ? begin : entries - M, lane);
}

/// May rows be taken M entries at a time?
template <int M, class S>
constexpr bool fits(int entries) {
  return M <= entries && M * sizeof(S) <= kVectorBytes;
}

template <int M, class S, int N>
inline void load_squares(const S* const* row, int entries, Pack<S, N>* to) {
  const auto lanes = [to](int i, int lane) { return reinterpret_cast<S*>(to + i) + lane; };
  if constexpr (M == 1) {
    for (int i = 0; i < entries; ++i)
      for (int lane = 0; lane < N; ++lane) std::memcpy(lanes(i, lane), row[lane] + i, sizeof(S));
  } else {
    if (!fits<M, S>(entries)) return load_squares<M / 2>(row, entries, to);
    squares<M, N>(entries, [&](int i, int lane) {
      transpose<S, M>([&](int k) { return row[lane + k] + i; },
                      [&](int k) { return lanes(i + k, lane); },
                      std::make_integer_sequence<int, M>());
    });
  }
}

template <int M, class S, int N>
inline void store_squares(const Pack<S, N>* from, int entries, int count, S* const* row) {
  const auto lanes = [from](int i, int lane) {
    return reinterpret_cast<const S*>(from + i) + lane;
  };
  if constexpr (M == 1) {
    for (int lane = 0; lane < count; ++lane)
      for (int i = 0; i < entries; ++i) std::memcpy(row[lane] + i, lanes(i, lane), sizeof(S));
  } else {
    if (!fits<M, S>(entries) || count < N) return store_squares<M / 2>(from, entries, count, row);
    squares<M, N>(entries, [&](int i, int lane) {
      transpose<S, M>([&](int k) { return lanes(i + k, lane); },
                      [&](int k) { return row[lane + k] + i; },
                      std::make_integer_sequence<int, M>());
    });
  }
}

}  // namespace detail

/// States first, first + 1, ... of n, one a lane, as `entries` packs; lanes beyond the last state
/// repeat it.
template <class S, int N>
inline void load(const Rows<const S>& from, int entries, std::size_t first, std::size_t n,
                 Pack<S, N>* to) {
  const S* row[N];
  for (std::size_t lane = 0; lane < N; ++lane)
    row[lane] = from.row(first + lane < n ? first + lane : n - 1, entries);
  detail::load_squares<N>(row, entries, to);
}

/// The other way; lanes beyond the last state are dropped.
template <class S, int N>
inline void store(const Pack<S, N>* from, int entries, std::size_t first, std::size_t n,
                  const Rows<S>& to) {
  S* row[N] = {};
  const int count = static_cast<int>(n - first < N ? n - first : N);
  for (int lane = 0; lane < count; ++lane)
    row[lane] = to.row(first + static_cast<std::size_t>(lane), entries);
  detail::store_squares<N>(from, entries, count, row);
}

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_ROWS_HPP

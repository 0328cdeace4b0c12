// One state with isomorphic limbs in the lanes of vectors: what such code needs beside + - * /.
//
// Scalars and vectors stand side by side; a scalar meets a vector in every lane.  GCC's and clang's
// vector types do this by themselves, so T is double or float; other scalars have the plain text, and
// so has every scalar where the processor has no vectors of double.
#ifndef ARBOC_LANES_HPP
#define ARBOC_LANES_HPP

#include <type_traits>
#include <utility>

#include "angles.hpp"

namespace arboc {
inline namespace v1 {

#if defined(ARBOC_ANGLES_IN_LANES)
#define ARBOC_HAS_LANES

namespace detail {

/// A vector of n values, and one that stands anywhere among scalars.
template <class T, int n>
struct LanesOf {
  typedef typename Pack<T, n>::Vector Vector;
  typedef Vector Anywhere __attribute__((aligned(sizeof(T)), may_alias));
};

}  // namespace detail

/// Does T go in lanes?
template <class T>
inline constexpr bool kHasLanes = false;
template <>
inline constexpr bool kHasLanes<double> = true;
template <>
inline constexpr bool kHasLanes<float> = true;

template <class T, int n>
using lanes_t = typename detail::LanesOf<T, n>::Vector;

/// n scalars side by side.
template <int n, class T>
ARBOC_INLINE const typename detail::LanesOf<T, n>::Anywhere& lanes(const T* values) {
  return *reinterpret_cast<const typename detail::LanesOf<T, n>::Anywhere*>(values);
}

namespace detail {

/// Lanes 2 and 3.
template <class T>
ARBOC_INLINE lanes_t<T, 2> upper_half(const lanes_t<T, 4>& x) {
#if ARBOC_HAS_BUILTIN(__builtin_shufflevector)
  return __builtin_shufflevector(x, x, 2, 3);
#else
  return lanes_t<T, 2>{x[2], x[3]};
#endif
}
template <class Vector>
using scalar_of = std::decay_t<decltype(std::declval<Vector>()[0] + 0)>;

}  // namespace detail

/// The sum of the first n lanes.
template <int n, class Vector>
ARBOC_INLINE auto hsum(const Vector& x) {
  static_assert(n >= 2 && n <= 4, "lanes");
  if constexpr (n == 4) {
    const lanes_t<detail::scalar_of<Vector>, 2> high =
        detail::upper_half<detail::scalar_of<Vector>>(x);
    return (x[0] + high[0]) + (x[1] + high[1]);
  } else if constexpr (n == 3) {
    return (x[0] + x[1]) + x[2];
  } else {
    return x[0] + x[1];
  }
}

/// Each lane to a place of its own.
template <class Vector, class T>
ARBOC_INLINE void scatter(const Vector& x, T* a, T* b) {
  *a = x[0];
  *b = x[1];
}
template <class Vector, class T>
ARBOC_INLINE void scatter(const Vector& x, T* a, T* b, T* c) {
  scatter(x, a, b);
  *c = x[2];
}
template <class Vector, class T>
ARBOC_INLINE void scatter(const Vector& x, T* a, T* b, T* c, T* d) {
  const lanes_t<T, 2> high = detail::upper_half<T>(x);
  scatter(x, a, b);
  scatter(high, c, d);
}

/// Lane k of x, y, z and u to the four places from a, b, c or d on: transposed in registers where
/// these hold four lanes.
template <class Vector, class T>
ARBOC_INLINE void store_rows(const Vector& x, const Vector& y, const Vector& z, const Vector& u,
                             T* a, T* b, T* c, T* d) {
#if ARBOC_HAS_BUILTIN(__builtin_shufflevector)
  if constexpr (sizeof(Vector) <= kVectorBytes) {
    using Row = typename detail::LanesOf<T, 4>::Anywhere;
    const Vector xy_even = __builtin_shufflevector(x, y, 0, 4, 2, 6);
    const Vector xy_odd = __builtin_shufflevector(x, y, 1, 5, 3, 7);
    const Vector zu_even = __builtin_shufflevector(z, u, 0, 4, 2, 6);
    const Vector zu_odd = __builtin_shufflevector(z, u, 1, 5, 3, 7);
    *reinterpret_cast<Row*>(a) = __builtin_shufflevector(xy_even, zu_even, 0, 1, 4, 5);
    *reinterpret_cast<Row*>(b) = __builtin_shufflevector(xy_odd, zu_odd, 0, 1, 4, 5);
    *reinterpret_cast<Row*>(c) = __builtin_shufflevector(xy_even, zu_even, 2, 3, 6, 7);
    *reinterpret_cast<Row*>(d) = __builtin_shufflevector(xy_odd, zu_odd, 2, 3, 6, 7);
    return;
  }
#endif
  scatter(x, a, b, c, d);
  scatter(y, a + 1, b + 1, c + 1, d + 1);
  scatter(z, a + 2, b + 2, c + 2, d + 2);
  scatter(u, a + 3, b + 3, c + 3, d + 3);
}

template <class Vector>
ARBOC_INLINE Vector lane_sqrt(const Vector& x) {
  using Scalar = detail::scalar_of<Vector>;
  return sqrt(Pack<Scalar, static_cast<int>(sizeof(Vector) / sizeof(Scalar))>(x)).v;
}

#endif

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_LANES_HPP

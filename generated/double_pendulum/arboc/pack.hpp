// N states in one scalar: the same generated code, evaluated for N states at a time.
//
// Pack<S, N> holds N values of type S, one a lane, and has what generated code asks of a scalar;
// lanes never influence one another.  GCC's and clang's vector types, C++17; whatever the machine
// has, the compiler splits wider packs.  Sine, cosine and the functions of rotations stand in
// pack_math.hpp.
#ifndef ARBOC_PACK_HPP
#define ARBOC_PACK_HPP

#include <cstdint>
#include <cstring>
#include <limits>

#include "scalar.hpp"

#if !defined(__GNUC__)
#error "arboc/pack.hpp needs the vector types of GCC or clang"
#endif

#define ARBOC_INLINE inline __attribute__((always_inline))

// clang fuses products into sums of another function only where both say that they allow it.
#if defined(__clang__)
#define ARBOC_FUSE _Pragma("clang fp contract(fast)")
#else
#define ARBOC_FUSE
#endif

#if defined(__has_builtin)
#define ARBOC_HAS_BUILTIN(x) __has_builtin(x)
#else
#define ARBOC_HAS_BUILTIN(x) 0
#endif

namespace arboc {
inline namespace v1 {

/// Bytes of the widest vectors that this translation unit may use.
inline constexpr int kVectorBytes =
#if defined(__AVX512F__)
    64;
#elif defined(__AVX__)
    32;
#else
    16;
#endif
/// Lanes of these: 8 doubles with AVX-512, 4 with AVX, otherwise 2.
template <class S>
inline constexpr int kLanes = kVectorBytes / static_cast<int>(sizeof(S));

namespace detail {

template <class S>
struct Bits;
template <>
struct Bits<double> {
  using Signed = std::int64_t;
  using Unsigned = std::uint64_t;
};
template <>
struct Bits<float> {
  using Signed = std::int32_t;
  using Unsigned = std::uint32_t;
};

}  // namespace detail

/// One truth value a lane: all bits of the lane or none.
template <class S, int N>
struct Mask {
  typedef typename detail::Bits<S>::Unsigned Vector
      __attribute__((vector_size(N * static_cast<int>(sizeof(S)))));
  Vector v;

  ARBOC_INLINE bool operator[](int lane) const { return v[lane] != 0; }
};

/// Aligned as its vector, by name: by itself GCC aligns vectors that the machine lacks less, and
/// translation units compiled for different machines would not fit together.
template <class S, int N>
struct alignas(N * sizeof(S)) Pack {
  static_assert(N > 1 && (N & (N - 1)) == 0, "a power of two");
  using Scalar = S;
  static constexpr int lanes = N;
  typedef S Vector __attribute__((vector_size(N * static_cast<int>(sizeof(S)))));
  Vector v;

  Pack() = default;
  ARBOC_INLINE explicit Pack(double x) : v(static_cast<S>(x) - Vector{}) {}
  ARBOC_INLINE explicit Pack(const Vector& x) : v(x) {}
  ARBOC_INLINE S operator[](int lane) const { return v[lane]; }
  ARBOC_INLINE void set(int lane, S x) { v[lane] = x; }

  friend ARBOC_INLINE Pack operator-(const Pack& a) { return Pack(-a.v); }
  friend ARBOC_INLINE Pack operator+(const Pack& a, const Pack& b) {
    ARBOC_FUSE
    return Pack(a.v + b.v);
  }
  friend ARBOC_INLINE Pack operator-(const Pack& a, const Pack& b) {
    ARBOC_FUSE
    return Pack(a.v - b.v);
  }
  friend ARBOC_INLINE Pack operator*(const Pack& a, const Pack& b) {
    ARBOC_FUSE
    return Pack(a.v * b.v);
  }
  friend ARBOC_INLINE Pack operator/(const Pack& a, const Pack& b) { return Pack(a.v / b.v); }
};

template <class S, int N>
ARBOC_INLINE Mask<S, N> operator!(const Mask<S, N>& a) {
  return {~a.v};
}
template <class S, int N>
ARBOC_INLINE Mask<S, N> operator&(const Mask<S, N>& a, const Mask<S, N>& b) {
  return {a.v & b.v};
}

namespace detail {

/// The bits of a pack, and back.
template <class S, int N>
ARBOC_INLINE Mask<S, N> bits(const Pack<S, N>& x) {
  return {reinterpret_cast<typename Mask<S, N>::Vector>(x.v)};
}
template <class S, int N>
ARBOC_INLINE Pack<S, N> pack(const Mask<S, N>& x) {
  return Pack<S, N>(reinterpret_cast<typename Pack<S, N>::Vector>(x.v));
}

/// The lower and the upper half of a vector, and the whole of two halves.
template <class Half, class Whole>
ARBOC_INLINE void split(const Whole& x, Half& low, Half& high) {
  static_assert(sizeof(Whole) == 2 * sizeof(Half), "halves");
  std::memcpy(&low, &x, sizeof low);
  std::memcpy(&high, reinterpret_cast<const char*>(&x) + sizeof low, sizeof high);
}
template <class Whole, class Half>
ARBOC_INLINE void join(const Half& low, const Half& high, Whole& x) {
  static_assert(sizeof(Whole) == 2 * sizeof(Half), "halves");
  std::memcpy(&x, &low, sizeof low);
  std::memcpy(reinterpret_cast<char*>(&x) + sizeof low, &high, sizeof high);
}

}  // namespace detail

/// (Compilers take comparisons of wider vectors apart lane by lane.)
template <class S, int N>
ARBOC_INLINE Mask<S, N> operator<(const Pack<S, N>& a, const Pack<S, N>& b) {
  Mask<S, N> less;
  if constexpr (sizeof(a) > kVectorBytes) {
    Pack<S, N / 2> a_low, a_high, b_low, b_high;
    detail::split(a, a_low, a_high);
    detail::split(b, b_low, b_high);
    detail::join(a_low < b_low, a_high < b_high, less);
  } else {
    less.v = reinterpret_cast<typename Mask<S, N>::Vector>(a.v < b.v);
  }
  return less;
}
template <class S, int N>
ARBOC_INLINE Mask<S, N> operator>(const Pack<S, N>& a, const Pack<S, N>& b) {
  return b < a;
}

/// Lane by lane: if_set where the mask is set.
template <class S, int N>
ARBOC_INLINE Pack<S, N> select(const Mask<S, N>& mask, const Pack<S, N>& if_set,
                               const Pack<S, N>& if_clear) {
  return detail::pack(
      Mask<S, N>{(detail::bits(if_set).v & mask.v) | (detail::bits(if_clear).v & ~mask.v)});
}

template <class S, int N>
ARBOC_INLINE Pack<S, N> fabs(const Pack<S, N>& x) {
  using Unsigned = typename detail::Bits<S>::Unsigned;
  return detail::pack(Mask<S, N>{detail::bits(x).v & (~Unsigned(0) >> 1)});
}

/// Is any lane set?
template <class S, int N>
ARBOC_INLINE bool any(const Mask<S, N>& mask) {
  constexpr int bytes = N * static_cast<int>(sizeof(S));
#if defined(__AVX__) && ARBOC_HAS_BUILTIN(__builtin_ia32_movmskps256)
  constexpr int widest = 32;
#else
  constexpr int widest = 16;
#endif
  if constexpr (bytes > widest) {
    Mask<S, N / 2> low, high;
    detail::split(mask, low, high);
    return any(Mask<S, N / 2>{low.v | high.v});
  } else {
#if defined(__AVX__) && ARBOC_HAS_BUILTIN(__builtin_ia32_movmskps256)
    if constexpr (bytes == 32)
      return __builtin_ia32_movmskps256(
                 reinterpret_cast<typename Pack<float, 8>::Vector>(mask.v)) != 0;
#endif
#if defined(__SSE2__) && ARBOC_HAS_BUILTIN(__builtin_ia32_movmskps)
    if constexpr (bytes == 16)
      return __builtin_ia32_movmskps(reinterpret_cast<typename Pack<float, 4>::Vector>(mask.v)) !=
             0;
#endif
    bool found = false;
    for (int lane = 0; lane < N; ++lane) found |= mask[lane];
    return found;
  }
}

/// Square root, correctly rounded; nan of negative values.
template <class S, int N>
ARBOC_INLINE Pack<S, N> sqrt(const Pack<S, N>& x) {
  constexpr int bytes = N * static_cast<int>(sizeof(S));
  constexpr bool doubles = sizeof(S) == sizeof(double);
  using Vector [[maybe_unused]] = typename Pack<S, N>::Vector;
#if ARBOC_HAS_BUILTIN(__builtin_elementwise_sqrt)
  return Pack<S, N>(Vector(__builtin_elementwise_sqrt(x.v)));
#else
#if defined(__AVX__) && ARBOC_HAS_BUILTIN(__builtin_ia32_sqrtpd256)
  if constexpr (bytes == 32) {
    if constexpr (doubles)
      return Pack<S, N>(Vector(__builtin_ia32_sqrtpd256(x.v)));
    else
      return Pack<S, N>(Vector(__builtin_ia32_sqrtps256(x.v)));
  }
#endif
#if defined(__SSE2__) && ARBOC_HAS_BUILTIN(__builtin_ia32_sqrtpd)
  if constexpr (bytes == 16) {
    if constexpr (doubles)
      return Pack<S, N>(Vector(__builtin_ia32_sqrtpd(x.v)));
    else
      return Pack<S, N>(Vector(__builtin_ia32_sqrtps(x.v)));
  }
#endif
  if constexpr (bytes > 16) {
    Pack<S, N / 2> low, high;
    Pack<S, N> root;
    detail::split(x, low, high);
    detail::join(sqrt(low), sqrt(high), root);
    return root;
  } else {
    Pack<S, N> root;
    for (int lane = 0; lane < N; ++lane) root.set(lane, math::sqrt(x[lane]));
    return root;
  }
#endif
}

/// What a checked function returns for N states: 0 a lane, or 1 + the index of the first value that
/// was not positive; in that lane all outputs are nan, and the others have theirs.
template <int N>
struct LaneStatus {
  int lane[N] = {};

  int operator[](int k) const { return lane[k]; }
  bool ok() const {
    int bits = 0;
    for (int k = 0; k < N; ++k) bits |= lane[k];
    return bits == 0;
  }
};

template <class S, int N>
struct Checked<Pack<S, N>> {
  using Status = LaneStatus<N>;

  static Status positive(const Pack<S, N>* values, int n) noexcept {
    Mask<S, N> all = values[0] > Pack<S, N>(0);
    for (int i = 1; i < n; ++i) all = all & (values[i] > Pack<S, N>(0));
    Status status;
    if (any(!all)) find(values, n, status);
    return status;
  }

  static void fill_nan(const Status& status, Pack<S, N>* values, int n) noexcept {
    if (status.ok()) return;
    for (int k = 0; k < N; ++k)
      if (status[k] != 0)
        for (int i = 0; i < n; ++i) values[i].set(k, std::numeric_limits<S>::quiet_NaN());
  }

 private:
  ARBOC_NOINLINE static void find(const Pack<S, N>* values, int n, Status& status) noexcept {
    for (int k = 0; k < N; ++k)
      status.lane[k] = Checked<S>::positive_of(n, [&](int i) { return values[i][k]; });
  }
};

}  // namespace v1
}  // namespace arboc

#include "pack_math.hpp"

#endif  // ARBOC_PACK_HPP

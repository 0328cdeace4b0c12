// Sines and cosines of several angles at a time: of double and float four in one vector, of other
// scalars one by one.
#ifndef ARBOC_ANGLES_HPP
#define ARBOC_ANGLES_HPP

#include "scalar.hpp"

// Where the processor has vectors of double; elsewhere, as on a microcontroller, one by one.
#if defined(__GNUC__) && (defined(__SSE2__) || defined(__aarch64__) || defined(__VSX__))
#define ARBOC_ANGLES_IN_LANES
#include "pack.hpp"
#endif

namespace arboc {
inline namespace v1 {

/// One to four angles (rad).
template <class T>
class Angles {
 public:
  Angles(const T& a) : x_{a, a, a, a}, n_(1) {}              // NOLINT: made from braces
  Angles(const T& a, const T& b) : x_{a, b, b, b}, n_(2) {}  // NOLINT
  Angles(const T& a, const T& b, const T& c) : x_{a, b, c, c}, n_(3) {}
  Angles(const T& a, const T& b, const T& c, const T& d) : x_{a, b, c, d}, n_(4) {}

  /// Writes as many sines and cosines; there is room for four of each.
  void sincos_to(T* sine, T* cosine) const {
    using arboc::sincos;
    for (int k = 0; k < n_; ++k) sincos(x_[k], sine[k], cosine[k]);
  }

 private:
  T x_[4];
  int n_;
};

#if defined(ARBOC_ANGLES_IN_LANES)

namespace detail {

/// Places that are not needed repeat the last angle: they cost nothing and are never slow.
template <class S>
class AnglesInLanes {
 public:
  ARBOC_INLINE AnglesInLanes(S a) : AnglesInLanes(a, a, a, a) {}       // NOLINT: from braces
  ARBOC_INLINE AnglesInLanes(S a, S b) : AnglesInLanes(a, b, b, b) {}  // NOLINT
  ARBOC_INLINE AnglesInLanes(S a, S b, S c) : AnglesInLanes(a, b, c, c) {}
  ARBOC_INLINE AnglesInLanes(S a, S b, S c, S d) : x_(typename Pack<S, 4>::Vector{a, b, c, d}) {}

  ARBOC_INLINE void sincos_to(S* sine, S* cosine) const {
    Pack<S, 4> s, c;
    sincos(x_, s, c);
    std::memcpy(sine, &s, sizeof s);
    std::memcpy(cosine, &c, sizeof c);
  }

 private:
  Pack<S, 4> x_;
};

}  // namespace detail

template <>
class Angles<double> : public detail::AnglesInLanes<double> {
  using AnglesInLanes::AnglesInLanes;
};
template <>
class Angles<float> : public detail::AnglesInLanes<float> {
  using AnglesInLanes::AnglesInLanes;
};

#endif

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_ANGLES_HPP

// Sine, cosine and the functions of rotations of packs, free of branches on single lanes.
//
// Included by pack.hpp.
#ifndef ARBOC_PACK_MATH_HPP
#define ARBOC_PACK_MATH_HPP

#include "pack.hpp"

namespace arboc {
inline namespace v1 {
namespace detail {

/// x = n pi/2 + y + z with |y| <= pi/4 and z below y's last place, for |x| < 1e5 (Cody and Waite).
/// pi/2 = P1 + P2 + P3, of which n P1 and n P2 are exact: with or without fused multiply-adds,
/// which the compiler may form at will, these are the same y and z up to the rounding of z.
template <int N>
struct Reduced {
  Pack<double, N> y, z;
  Mask<double, N> n;  ///< integers, modulo 2^51
};
template <int N>
ARBOC_INLINE Reduced<N> reduce(const Pack<double, N>& x) {
  using P = Pack<double, N>;
  const P two_over_pi(0x1.45f306dc9c883p-1), round(0x1.8p52);
  const P p1(0x1.921fb5444p+0), p2(0x1.68c234c4p-39), p3(0x1.8cc51701b839ap-72);
  const P t = x * two_over_pi + round;
  const P n = t - round;
  const P r = x - n * p1;
  const P y = r - n * p2;
  const P z = ((r - y) - n * p2) - n * p3;
  return {y, z, bits(t)};
}

/// sine and cosine of y + z, |y| <= pi/4: the minimax polynomials of fdlibm's kernel functions.
template <int N>
ARBOC_INLINE void kernel(const Pack<double, N>& y, const Pack<double, N>& z, Pack<double, N>& sine,
                         Pack<double, N>& cosine) {
  using P = Pack<double, N>;
  const P y2 = y * y, y3 = y2 * y;
  P s = P(-2.50507602534068634195e-08) + y2 * P(1.58969099521155010221e-10);
  s = P(2.75573137070700676789e-06) + y2 * s;
  s = P(-1.98412698298579493134e-04) + y2 * s;
  s = P(8.33333333332248946124e-03) + y2 * s;
  sine = y - ((y2 * (P(0.5) * z - y3 * s) - z) + y3 * P(1.66666666666666324348e-01));
  P c = P(2.08757232129817482790e-09) + y2 * P(-1.13596475577881948265e-11);
  c = P(-2.75573143513906633035e-07) + y2 * c;
  c = P(2.48015872894767294178e-05) + y2 * c;
  c = P(-1.38888888888741095749e-03) + y2 * c;
  c = P(4.16666666666666019037e-02) + y2 * c;
  const P half = P(0.5) * y2;
  const P w = P(1) - half;
  cosine = w + (((P(1) - w) - half) + (y2 * (y2 * c) - y * z));
}

/// The same in float, of y alone.
template <int N>
ARBOC_INLINE void kernel(const Pack<float, N>& y, Pack<float, N>& sine, Pack<float, N>& cosine) {
  using P = Pack<float, N>;
  const P y2 = y * y;
  P s = P(-0.000198393348360966317347) + y2 * P(0.0000027183114939898219064);
  s = P(0.0083333293858894631756) + y2 * s;
  s = P(-0.166666666416265235595) + y2 * s;
  sine = y + (y2 * y) * s;
  P c = P(-0.00138867637746099294692) + y2 * P(0.0000243904487962774090654);
  c = P(0.0416666233237390631894) + y2 * c;
  const P half = P(0.5) * y2;
  const P w = P(1) - half;
  cosine = w + (((P(1) - w) - half) + y2 * (y2 * c));
}

/// The quadrant n of sine and cosine.
template <class S, int N>
ARBOC_INLINE void turn(const Mask<S, N>& n, Pack<S, N>& sine, Pack<S, N>& cosine) {
  using Unsigned = typename Bits<S>::Unsigned;
  constexpr int to_sign = 8 * static_cast<int>(sizeof(S)) - 2;
  constexpr Unsigned one = 1, two = 2;
  const Mask<S, N> swap{typename Mask<S, N>::Vector{} - (n.v & one)};
  const Pack<S, N> s = select(swap, cosine, sine), c = select(swap, sine, cosine);
  sine = pack(Mask<S, N>{bits(s).v ^ ((n.v & two) << to_sign)});
  cosine = pack(Mask<S, N>{bits(c).v ^ (((n.v + one) & two) << to_sign)});
}

/// Argument reduction in double of floats: x = n pi/2 + y.  (GCC takes conversions to more than 64
/// bytes apart lane by lane.)
template <int N>
ARBOC_INLINE void reduce(const Pack<float, N>& x, Pack<float, N>& y, Mask<float, N>& n) {
  if constexpr (2 * sizeof(x) > 64) {
    Pack<float, N / 2> x_low, x_high, y_low, y_high;
    Mask<float, N / 2> n_low, n_high;
    split(x, x_low, x_high);
    reduce(x_low, y_low, n_low);
    reduce(x_high, y_high, n_high);
    join(y_low, y_high, y);
    join(n_low, n_high, n);
  } else {
    Pack<double, N> wide;
    wide.v = __builtin_convertvector(x.v, typename Pack<double, N>::Vector);
    const Reduced<N> r = reduce(wide);
    y.v = __builtin_convertvector(r.y.v, typename Pack<float, N>::Vector);
    n.v = __builtin_convertvector(r.n.v, typename Mask<float, N>::Vector);
  }
}

/// Lanes where |x| < 1e5 does not hold, by the C library.
template <class S, int N>
ARBOC_NOINLINE void large_angles(const Pack<S, N>& x, Pack<S, N>& sine, Pack<S, N>& cosine) {
  for (int lane = 0; lane < N; ++lane) {
    if (math::fabs(x[lane]) < S(1e5)) continue;
    sine.set(lane, math::sin(x[lane]));
    cosine.set(lane, math::cos(x[lane]));
  }
}

template <int N>
ARBOC_INLINE void small_angles(const Pack<double, N>& x, Pack<double, N>& sine,
                               Pack<double, N>& cosine) {
  const Reduced<N> r = reduce(x);
  kernel(r.y, r.z, sine, cosine);
  turn(r.n, sine, cosine);
}
template <int N>
ARBOC_INLINE void small_angles(const Pack<float, N>& x, Pack<float, N>& sine,
                               Pack<float, N>& cosine) {
  Pack<float, N> y;
  Mask<float, N> n;
  reduce(x, y, n);
  kernel(y, sine, cosine);
  turn(n, sine, cosine);
}

}  // namespace detail

#if defined(__FAST_MATH__)

// A compiler that may change the order of additions breaks the reduction.
template <class S, int N>
inline void sincos(const Pack<S, N>& x, Pack<S, N>& sine, Pack<S, N>& cosine) noexcept {
  for (int lane = 0; lane < N; ++lane) {
    const S angle = x[lane];
    sine.set(lane, math::sin(angle));
    cosine.set(lane, math::cos(angle));
  }
}

#else

/// Sine and cosine of x (rad).  In lanes where |x| < 1e5 without branches, of doubles at most 1
/// ulp, of floats 1.5 (the reduction in double, the polynomials in float); in others, and of nan
/// and infinity, the C library's.
template <class S, int N>
ARBOC_INLINE void sincos(const Pack<S, N>& x, Pack<S, N>& sine, Pack<S, N>& cosine) noexcept {
  if constexpr (sizeof(x) > kVectorBytes) {
    Pack<S, N / 2> x_low, x_high, s_low, s_high, c_low, c_high;
    detail::split(x, x_low, x_high);
    sincos(x_low, s_low, c_low);
    sincos(x_high, s_high, c_high);
    detail::join(s_low, s_high, sine);
    detail::join(c_low, c_high, cosine);
  } else {
    const Pack<S, N> angle = x;
    Pack<S, N> s, c;
    detail::small_angles(angle, s, c);
    sine = s;
    cosine = c;
    if (__builtin_expect(any(!(fabs(angle) < Pack<S, N>(1e5))), 0))
      detail::large_angles(angle, sine, cosine);
  }
}

#endif

namespace detail {

/// h / sin h where c = cos h >= 0: by arcsine's rational R of fdlibm, asin(x) = x + x R(x^2) for
/// |x| <= 1/2, of sin(h / 2) or of c.
template <class P>
inline P arc_ratio_of_pack(const P& c) {
  const P u = P(1) - c;
  const auto low = c < P(0.5);
  const P z = select(low, c * c, P(0.5) * u);
  P p = P(7.91534994289814532176e-04) + z * P(3.47933107596021167570e-05);
  p = P(-4.00555345006794114027e-02) + z * p;
  p = P(2.01212532134862925881e-01) + z * p;
  p = P(-3.25565818622400915405e-01) + z * p;
  p = z * (P(1.66666666666666657415e-01) + z * p);
  P q = P(-6.88283971605453293030e-01) + z * P(7.70381505559019352791e-02);
  q = P(2.02094576023350569471e+00) + z * q;
  q = P(-2.40339491173441421878e+00) + z * q;
  q = P(1) + z * q;
  const P R = p / q;
  const P arc = select(low, P(1.57079632679489661923) - (c + c * R), P(1) + R);
  return arc / sqrt(select(low, u, P(0.5)) * (P(1) + c));
}

}  // namespace detail

/// As for scalars; a lane's value depends on that lane alone.
template <class S, int N>
struct Rotations<Pack<S, N>> {
  using P = Pack<S, N>;

  template <int k>
  static P stumpff(const P& x) {
    const P near = detail::stumpff_series<k>(x);
    const Mask<S, N> is_near = x < P(0.5 * (k + 1) * (k + 2));
    if (!any(!is_near)) return near;
    return select(is_near, near, far<k>(x));
  }
  static P quaternion_log(const P& w) {
    return select(w < P(0), P(-2), P(2)) * detail::arc_ratio_of_pack(fabs(w));
  }
  static P log_curvature(const P& w) {
    const P c = fabs(w);
    return detail::curvature(c, detail::arc_ratio_of_pack(c));
  }

 private:
  template <int k>
  static P far(const P& x) {
    if constexpr (k > 2) {
      return (P(detail::inverse_factorial(k - 2)) - stumpff<k - 2>(x)) / x;
    } else if constexpr (k == 2) {
      const P half = stumpff<1>(P(0.25) * x);
      return P(0.5) * half * half;
    } else {
      const P root = sqrt(x);
      P sine, cosine;
      sincos(root, sine, cosine);
      if constexpr (k == 0) return cosine;
      return sine / root;
    }
  }
};

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_PACK_MATH_HPP

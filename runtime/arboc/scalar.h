// The runtime of generated C: what it needs beside + - * /, for casadi_real float or double.
//
// The functions are those of arboc/scalar.hpp, which says what each is and how it is computed; C99
// and libm.
#ifndef ARBOC_SCALAR_H
#define ARBOC_SCALAR_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "casadi.h"

#if defined(__GNUC__)
#define ARBOC_RESTRICT __restrict__
#define ARBOC_NOINLINE __attribute__((noinline))
#else
#define ARBOC_RESTRICT restrict
#define ARBOC_NOINLINE
#endif

#define ARBOC_SINGLE (sizeof(casadi_real) == sizeof(float))
#define ARBOC_OF_LIBM(single, twice, x) \
  (ARBOC_SINGLE ? (casadi_real)single((float)(x)) : (casadi_real)twice((double)(x)))

static inline casadi_real arboc_sqrt(casadi_real x) { return ARBOC_OF_LIBM(sqrtf, sqrt, x); }
static inline casadi_real arboc_sin(casadi_real x) { return ARBOC_OF_LIBM(sinf, sin, x); }
static inline casadi_real arboc_cos(casadi_real x) { return ARBOC_OF_LIBM(cosf, cos, x); }
static inline casadi_real arboc_acos(casadi_real x) { return ARBOC_OF_LIBM(acosf, acos, x); }

#if (defined(__FMA__) || defined(__FP_FAST_FMA) || defined(__aarch64__)) && !defined(__FAST_MATH__)

static inline double arboc_select(uint64_t mask, double if_set, double if_clear, uint64_t sign) {
  uint64_t a, b;
  memcpy(&a, &if_set, sizeof a);
  memcpy(&b, &if_clear, sizeof b);
  a = ((a & mask) | (b & ~mask)) ^ sign;
  memcpy(&if_set, &a, sizeof a);
  return if_set;
}

static inline void arboc_sincos_double(double x, double* sine, double* cosine) {
  const double kP1 = 0x1.921fb54442d18p+0, kP2 = 0x1.1a62633145c07p-54;
  const double kP3 = -0x1.f1976b7ed8fbcp-110, kRound = 0x1.8p52;
  double t, n, r, p, y, z, y2, y3, s, sine_y, c, half, w, cosine_y;
  uint64_t quadrant, swap;
  if (!(fabs(x) < 1e5)) {
    *sine = sin(x);
    *cosine = cos(x);
    return;
  }
  t = fma(x, 0x1.45f306dc9c883p-1, kRound);
  memcpy(&quadrant, &t, sizeof quadrant);
  n = t - kRound;
  r = fma(-n, kP1, x);
  p = n * kP2;
  y = r - p;
  z = ((r - y) - p) - fma(n, kP2, -p) - n * kP3;
  y2 = y * y;
  y3 = y2 * y;
  s = 8.33333333332248946124e-03 +
      y2 * (-1.98412698298579493134e-04 +
            y2 * (2.75573137070700676789e-06 +
                  y2 * (-2.50507602534068634195e-08 + y2 * 1.58969099521155010221e-10)));
  sine_y = y - ((y2 * (0.5 * z - y3 * s) - z) - y3 * -1.66666666666666324348e-01);
  c = y2 *
      (4.16666666666666019037e-02 +
       y2 * (-1.38888888888741095749e-03 +
             y2 * (2.48015872894767294178e-05 +
                   y2 * (-2.75573143513906633035e-07 +
                         y2 * (2.08757232129817482790e-09 + y2 * -1.13596475577881948265e-11)))));
  half = 0.5 * y2;
  w = 1.0 - half;
  cosine_y = w + (((1.0 - w) - half) + (y2 * c - y * z));
  swap = 0 - (quadrant & 1);
  *sine = arboc_select(swap, cosine_y, sine_y, (quadrant & 2) << 62);
  *cosine = arboc_select(swap, sine_y, cosine_y, ((quadrant + 1) & 2) << 62);
}

#else

static inline void arboc_sincos_double(double x, double* sine, double* cosine) {
  *sine = sin(x);
  *cosine = cos(x);
}

#endif

static inline void arboc_sincos(casadi_real x, casadi_real* sine, casadi_real* cosine) {
  if (ARBOC_SINGLE) {
    *sine = arboc_sin(x);
    *cosine = arboc_cos(x);
  } else {
    double s, c;
    arboc_sincos_double((double)x, &s, &c);
    *sine = (casadi_real)s;
    *cosine = (casadi_real)c;
  }
}

static inline casadi_real arboc_inverse_factorial(int n) {
  double value = 1;
  int i;
  for (i = 2; i <= n; ++i) value /= i;
  return (casadi_real)value;
}

// c_k(x) = sum_i (-x)^i / (k + 2 i)!
static inline casadi_real arboc_stumpff(int k, casadi_real x) {
  if (x < (casadi_real)(0.5 * (k + 1) * (k + 2))) {
    casadi_real sum = 1;
    int i;
    for (i = 10 + 3 * k / 2; i > 0; --i)
      sum = 1 - (casadi_real)(1.0 / ((k + 2 * i - 1) * (k + 2 * i))) * x * sum;
    return arboc_inverse_factorial(k) * sum;
  }
  if (k > 2) return (arboc_inverse_factorial(k - 2) - arboc_stumpff(k - 2, x)) / x;
  if (k == 2) {
    const casadi_real half = arboc_stumpff(1, (casadi_real)0.25 * x);
    return (casadi_real)0.5 * half * half;
  } else {
    const casadi_real root = arboc_sqrt(x);
    casadi_real sine, cosine;
    arboc_sincos(root, &sine, &cosine);
    return k == 0 ? cosine : sine / root;
  }
}

// acos(w) / sqrt(1 - w^2), w > -1
static inline casadi_real arboc_arc_ratio(casadi_real w) {
  const casadi_real u = 1 - w;
  casadi_real sum = 1;
  int n;
  if (!(u < (casadi_real)0.02)) return arboc_acos(w) / arboc_sqrt(u * (1 + w));
  for (n = 9; n > 0; --n) sum = 1 + (casadi_real)(n / (2.0 * n + 1)) * u * sum;
  return sum;
}

// 2 sign(w) acos(|w|) / sqrt(1 - w^2), sign(0) = 1
static inline casadi_real arboc_quaternion_log(casadi_real w) {
  return w < 0 ? -2 * arboc_arc_ratio(-w) : 2 * arboc_arc_ratio(w);
}

// (1 - h cot h) / (4 h^2), h = acos(|w|)
static inline casadi_real arboc_log_curvature(casadi_real w) {
  static const double kRest[] = {
      0.64493406684822643647,   0.082323233711138191516,  0.017343061984449139714,
      0.0040773561979443393787, 9.9457512781808533715e-4, 2.4608655330804829863e-4,
      6.1248135058704829258e-5, 1.5282259408651871733e-5, 3.8172932649998398565e-6,
      9.5396203387279611315e-7, 2.3845050272773299001e-7, 5.9608189051259479612e-8,
      1.4901554828365041235e-8, 3.7253340247884570549e-9, 9.3132743241966818288e-10};
  const double kInversePi2 = 0.10132118364233777144;
  const casadi_real c = w < 0 ? -w : w, ratio = arboc_arc_ratio(c);
  const casadi_real y = ((casadi_real)kInversePi2 * ratio) * (ratio * ((1 - c) * (1 + c)));
  casadi_real rest = 0;
  int n;
  for (n = 14; n >= 0; --n) rest = rest * y + (casadi_real)kRest[n];
  return (casadi_real)(0.5 * kInversePi2) * (1 / (1 - y) + rest);
}

// 0, or 1 + the index of the first of n values that is not positive.
static inline int arboc_check_positive(const casadi_real* values, int n) {
  int i;
  for (i = 0; i < n; ++i)
    if (!(values[i] > 0)) return 1 + i;
  return 0;
}

static inline void arboc_fill_nan(casadi_real* values, int n) {
  int i;
  for (i = 0; i < n; ++i) values[i] = (casadi_real)NAN;
}

#endif

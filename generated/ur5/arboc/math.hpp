// The functions of the C library that emitted code calls, of double, float and long double.
//
// Not by <cmath>, where the compiler has them built in: reading that header takes longer than
// compiling all of a small function.
#ifndef ARBOC_MATH_HPP
#define ARBOC_MATH_HPP

#if !defined(__GNUC__)
#include <cmath>
#endif

namespace arboc {
inline namespace v1 {
namespace math {

#if defined(__GNUC__)

inline double sin(double x) { return __builtin_sin(x); }
inline double cos(double x) { return __builtin_cos(x); }
inline double acos(double x) { return __builtin_acos(x); }
inline double sqrt(double x) { return __builtin_sqrt(x); }
inline double fabs(double x) { return __builtin_fabs(x); }
inline double fma(double x, double y, double z) { return __builtin_fma(x, y, z); }

inline float sin(float x) { return __builtin_sinf(x); }
inline float cos(float x) { return __builtin_cosf(x); }
inline float acos(float x) { return __builtin_acosf(x); }
inline float sqrt(float x) { return __builtin_sqrtf(x); }
inline float fabs(float x) { return __builtin_fabsf(x); }

inline long double sin(long double x) { return __builtin_sinl(x); }
inline long double cos(long double x) { return __builtin_cosl(x); }
inline long double acos(long double x) { return __builtin_acosl(x); }
inline long double sqrt(long double x) { return __builtin_sqrtl(x); }
inline long double fabs(long double x) { return __builtin_fabsl(x); }

#else

using std::acos;
using std::cos;
using std::fabs;
using std::fma;
using std::sin;
using std::sqrt;

#endif

}  // namespace math
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_MATH_HPP

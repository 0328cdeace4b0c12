// Sines and cosines that are the same on every machine.
//
// Constants of generated code come from written angles (rpy, theta, alpha).  libm's sine differs
// between processors in the last bit, so these are computed in double-double and rounded once.
#pragma once
#include <optional>

namespace arboc {

struct SinCos {
  double sin = 0.0;
  double cos = 1.0;
};

/// Sine and cosine of `angle` (rad, |angle| < 1e9), within 0.5001 ulp.  An angle within 4 eps
/// (relative) of a multiple of 15 degrees is that multiple: the result is then correctly rounded
/// for the multiple, so pi/2 as a double gives exactly 1 and 0.  Each takes a microsecond; the last
/// ones are remembered, because derivatives by differences ask for the same angles again and again.
SinCos exact_sincos(double angle);

/// k if `angle` is within `tolerance` rad of k * 15 degrees.
std::optional<long> multiple_of_15_degrees(double angle, double tolerance);

/// The double nearest to k * 15 degrees, in rad.
double degrees15(long k);

}  // namespace arboc

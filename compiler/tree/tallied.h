// Constants that know how far they can be from zero by rounding alone.
//
// Composing placements leaves entries such as 1e-17 where exact arithmetic has 0, and then no zero
// folds.  A Tallied carries, beside its value, the sum of the magnitudes of the terms it was added
// up from; clean() makes it 0 when it is within 4 eps of that sum.  Rounding, not a model change.
#pragma once
#include <cmath>
#include <limits>

#include "spatial/matrix3.h"
#include "tree/dynamic_tree.h"

namespace arboc {

struct Tallied {
  double value = 0;
  double size = 0;

  Tallied() = default;
  Tallied(double x) : value(x), size(std::fabs(x)) {}  // NOLINT: constants mix freely
  Tallied(double x, double bound) : value(x), size(bound) {}

  friend Tallied operator+(Tallied a, Tallied b) { return {a.value + b.value, a.size + b.size}; }
  friend Tallied operator-(Tallied a, Tallied b) { return {a.value - b.value, a.size + b.size}; }
  friend Tallied operator*(Tallied a, Tallied b) { return {a.value * b.value, a.size * b.size}; }
  Tallied operator-() const { return {-value, size}; }
};

constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

inline double clean(Tallied x) { return std::fabs(x.value) <= kRounding * x.size ? 0.0 : x.value; }
inline Vector3<double> clean(const Vector3<Tallied>& a) {
  return {clean(a.x), clean(a.y), clean(a.z)};
}
inline Symmetric3<double> clean(const Symmetric3<Tallied>& A) {
  return {clean(A.xx), clean(A.yy), clean(A.zz), clean(A.xy), clean(A.xz), clean(A.yz)};
}

/// An entry of a rotation: within 4 eps of 0 or +-1 it is meant to be that.
inline double clean_unit(double x) {
  const double nearest = std::nearbyint(x);
  return std::fabs(nearest) <= 1 && std::fabs(x - nearest) <= kRounding ? nearest + 0.0 : x;
}
inline Turn clean_unit(const Turn& turn) { return {clean_unit(turn.c), clean_unit(turn.s)}; }
inline Matrix3<double> clean_unit(Matrix3<double> R) {
  for (auto& row : R.m)
    for (double& entry : row) entry = clean_unit(entry);
  return R;
}

inline Matrix3<Tallied> tallied(const Matrix3<double>& A) {
  Matrix3<Tallied> B;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) B(i, j) = A(i, j);
  return B;
}
inline Vector3<Tallied> tallied(const Vector3<double>& a) { return {a.x, a.y, a.z}; }
inline Symmetric3<Tallied> tallied(const Symmetric3<double>& A) {
  return {A.xx, A.yy, A.zz, A.xy, A.xz, A.yz};
}

/// R S, cleaned.
inline Matrix3<double> rotate(const Matrix3<double>& R, const Matrix3<double>& S) {
  return clean_unit(R * S);
}
/// R x + p, cleaned.
inline Vector3<double> place(const Matrix3<double>& R, const Vector3<double>& x,
                             const Vector3<double>& p) {
  return clean(tallied(R) * tallied(x) + tallied(p));
}

/// The same with symbols, whose zeros fold by themselves.
template <class S>
Vector3<S> place(const Matrix3<double>& R, const Vector3<S>& x, const Vector3<S>& p) {
  return cast<S>(R) * x + p;
}

}  // namespace arboc

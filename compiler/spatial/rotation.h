// Rotations about z and x by (cosine, sine): of vectors, and of 3x3 matrices as congruences.
//
// A planar rotation costs 4 operations a vector, a dense one 9, so the algorithms never form a
// rotation matrix: every constant placement is Rz Rx Rz, every joint turns about z.  C is T or
// double; where a constant cosine or sine is 0 or +-1 the traced operation folds away.
// docs/theory.md section 6.
#pragma once
#include "spatial/matrix3.h"

namespace arboc {

/// A planar rotation by its cosine and sine; the angle itself is never needed.
template <class C>
struct PlanarRotation {
  C c = C(1);
  C s = C(0);
};

/// The same rotation on another scalar.
template <class T, class C>
PlanarRotation<T> cast(const PlanarRotation<C>& r) {
  return {T(r.c), T(r.s)};
}

template <class C, class T>
ARBOC_INLINE Vector3<T> rotate_z(const PlanarRotation<C>& r, const Vector3<T>& a) {
  return {r.c * a.x - r.s * a.y, r.s * a.x + r.c * a.y, a.z};
}
template <class C, class T>
ARBOC_INLINE Vector3<T> rotate_back_z(const PlanarRotation<C>& r, const Vector3<T>& a) {
  return {r.c * a.x + r.s * a.y, r.c * a.y - r.s * a.x, a.z};
}
template <class C, class T>
ARBOC_INLINE Vector3<T> rotate_x(const PlanarRotation<C>& r, const Vector3<T>& a) {
  return {a.x, r.c * a.y - r.s * a.z, r.s * a.y + r.c * a.z};
}
template <class C, class T>
ARBOC_INLINE Vector3<T> rotate_back_x(const PlanarRotation<C>& r, const Vector3<T>& a) {
  return {a.x, r.c * a.y + r.s * a.z, r.c * a.z - r.s * a.y};
}
/// The rotation by the sum of both angles.
template <class C, class T>
PlanarRotation<T> compose(const PlanarRotation<C>& a, const PlanarRotation<T>& b) {
  return {a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s};
}

/// Rz A Rz^T.
template <class C, class T>
ARBOC_INLINE Symmetric3<T> congruence_z(const PlanarRotation<C>& r, const Symmetric3<T>& A) {
  const T u = r.s * (A.xx - A.yy) + r.c * (A.xy + A.xy);
  return {A.xx - r.s * u, A.yy + r.s * u,          A.zz,
          r.c * u - A.xy, r.c * A.xz - r.s * A.yz, r.s * A.xz + r.c * A.yz};
}
/// Rx A Rx^T: the same with x, y, z renamed y, z, x.
template <class C, class T>
ARBOC_INLINE Symmetric3<T> congruence_x(const PlanarRotation<C>& r, const Symmetric3<T>& A) {
  const T u = r.s * (A.yy - A.zz) + r.c * (A.yz + A.yz);
  return {A.xx,
          A.yy - r.s * u,
          A.zz + r.s * u,
          r.c * A.xy - r.s * A.xz,
          r.s * A.xy + r.c * A.xz,
          r.c * u - A.yz};
}
/// Rz A Rz^T of a general A.
template <class C, class T>
Matrix3<T> congruence_z(const PlanarRotation<C>& r, const Matrix3<T>& A) {
  const T u = r.s * (A(0, 0) - A(1, 1)) + r.c * (A(0, 1) + A(1, 0));
  const T t = r.c * u;
  return {{{A(0, 0) - r.s * u, t - A(1, 0), r.c * A(0, 2) - r.s * A(1, 2)},
           {t - A(0, 1), A(1, 1) + r.s * u, r.s * A(0, 2) + r.c * A(1, 2)},
           {r.c * A(2, 0) - r.s * A(2, 1), r.s * A(2, 0) + r.c * A(2, 1), A(2, 2)}}};
}
/// Rx A Rx^T of a general A.
template <class C, class T>
Matrix3<T> congruence_x(const PlanarRotation<C>& r, const Matrix3<T>& A) {
  const T u = r.s * (A(1, 1) - A(2, 2)) + r.c * (A(1, 2) + A(2, 1));
  const T t = r.c * u;
  return {{{A(0, 0), r.c * A(0, 1) - r.s * A(0, 2), r.s * A(0, 1) + r.c * A(0, 2)},
           {r.c * A(1, 0) - r.s * A(2, 0), A(1, 1) - r.s * u, t - A(2, 1)},
           {r.s * A(1, 0) + r.c * A(2, 0), t - A(1, 2), A(2, 2) + r.s * u}}};
}

/// The rotation matrix of a quaternion x y z w of norm 1 (which is assumed, not enforced).
template <class T>
Matrix3<T> rotation_of_quaternion(const T* q) {
  const T X = T(2) * q[0], Y = T(2) * q[1], Z = T(2) * q[2];
  const T xx = X * q[0], yy = Y * q[1], zz = Z * q[2];
  const T xy = X * q[1], xz = X * q[2], yz = Y * q[2];
  const T xw = X * q[3], yw = Y * q[3], zw = Z * q[3];
  return {{{T(1) - (yy + zz), xy - zw, xz + yw},
           {xy + zw, T(1) - (xx + zz), yz - xw},
           {xz - yw, yz + xw, T(1) - (xx + yy)}}};
}
/// A^T b.
template <class T>
ARBOC_INLINE Vector3<T> transpose_apply(const Matrix3<T>& A, const Vector3<T>& b) {
  return {A(0, 0) * b.x + A(1, 0) * b.y + A(2, 0) * b.z,
          A(0, 1) * b.x + A(1, 1) * b.y + A(2, 1) * b.z,
          A(0, 2) * b.x + A(1, 2) * b.y + A(2, 2) * b.z};
}
/// A S A^T.
template <class T>
ARBOC_INLINE Symmetric3<T> congruence(const Matrix3<T>& A, const Symmetric3<T>& S) {
  const Vector3<T> x = S * Vector3<T>{A(0, 0), A(0, 1), A(0, 2)};
  const Vector3<T> y = S * Vector3<T>{A(1, 0), A(1, 1), A(1, 2)};
  const Vector3<T> z = S * Vector3<T>{A(2, 0), A(2, 1), A(2, 2)};
  const auto row = [&](int i, const Vector3<T>& b) {
    return A(i, 0) * b.x + A(i, 1) * b.y + A(i, 2) * b.z;
  };
  return {row(0, x), row(1, y), row(2, z), row(0, y), row(0, z), row(1, z)};
}

}  // namespace arboc

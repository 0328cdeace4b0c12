// 3x3 matrices, general and symmetric, on any scalar T.
#pragma once
#include "spatial/vector3.h"

namespace arboc {

/// General 3x3 matrix, m[row][column].
template <class T>
struct Matrix3 {
  T m[3][3]{};

  T& operator()(int row, int column) { return m[row][column]; }
  const T& operator()(int row, int column) const { return m[row][column]; }

  static Matrix3 identity() {
    return {{{T(1), T(0), T(0)}, {T(0), T(1), T(0)}, {T(0), T(0), T(1)}}};
  }
};

/// Symmetric 3x3 matrix by its six distinct entries.
template <class T>
struct Symmetric3 {
  T xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
};

template <class T>
Matrix3<T> operator*(const Matrix3<T>& A, const Matrix3<T>& B) {
  Matrix3<T> C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C(i, j) = A(i, 0) * B(0, j) + A(i, 1) * B(1, j) + A(i, 2) * B(2, j);
  return C;
}
template <class T>
ARBOC_INLINE Vector3<T> operator*(const Matrix3<T>& A, const Vector3<T>& b) {
  return {A(0, 0) * b.x + A(0, 1) * b.y + A(0, 2) * b.z,
          A(1, 0) * b.x + A(1, 1) * b.y + A(1, 2) * b.z,
          A(2, 0) * b.x + A(2, 1) * b.y + A(2, 2) * b.z};
}
template <class T>
Matrix3<T> transpose(const Matrix3<T>& A) {
  Matrix3<T> B;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) B(i, j) = A(j, i);
  return B;
}
template <class T>
Vector3<T> column(const Matrix3<T>& A, int j) {
  return {A(0, j), A(1, j), A(2, j)};
}
template <class T>
Matrix3<T> full(const Symmetric3<T>& S) {
  return {{{S.xx, S.xy, S.xz}, {S.xy, S.yy, S.yz}, {S.xz, S.yz, S.zz}}};
}
/// The upper triangle of a matrix that is symmetric up to rounding.
template <class T>
Symmetric3<T> symmetric(const Matrix3<T>& A) {
  return {A(0, 0), A(1, 1), A(2, 2), A(0, 1), A(0, 2), A(1, 2)};
}
template <class T>
Symmetric3<T> operator+(const Symmetric3<T>& A, const Symmetric3<T>& B) {
  return {A.xx + B.xx, A.yy + B.yy, A.zz + B.zz, A.xy + B.xy, A.xz + B.xz, A.yz + B.yz};
}
template <class T>
Symmetric3<T>& operator+=(Symmetric3<T>& A, const Symmetric3<T>& B) {
  return A = A + B;
}
/// The same matrix on another scalar.
template <class T, class S>
Matrix3<T> cast(const Matrix3<S>& A) {
  Matrix3<T> B;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) B(i, j) = T(A(i, j));
  return B;
}
template <class T, class S>
Symmetric3<T> cast(const Symmetric3<S>& A) {
  return {T(A.xx), T(A.yy), T(A.zz), T(A.xy), T(A.xz), T(A.yz)};
}
/// A b.
template <class T, class S>
auto operator*(const Symmetric3<T>& A, const Vector3<S>& b) -> Vector3<decltype(A.xx * b.x)> {
  return {A.xx * b.x + A.xy * b.y + A.xz * b.z, A.xy * b.x + A.yy * b.y + A.yz * b.z,
          A.xz * b.x + A.yz * b.y + A.zz * b.z};
}

}  // namespace arboc

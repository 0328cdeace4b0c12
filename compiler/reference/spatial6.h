// Spatial vectors as plain six-vectors and 6x6 matrices, angular part first, on any scalar.
//
// Everything as [RBDA] chapter 2 writes it and nothing made fast: a transform is a full 6x6
// matrix, so that each line of the algorithms is a line of the book.  Complex numbers are meant for
// derivatives by complex step, so nothing here may conjugate: no dot(), norm() or adjoint().
#pragma once
#include <Eigen/Core>

namespace arboc::spatial6 {

template <class S>
using Vec3 = Eigen::Matrix<S, 3, 1>;
template <class S>
using Mat3 = Eigen::Matrix<S, 3, 3>;
template <class S>
using Vector6 = Eigen::Matrix<S, 6, 1>;
template <class S>
using Matrix6 = Eigen::Matrix<S, 6, 6>;

/// The matrix of r x.  [RBDA] (2.23)
template <class D, class S = typename D::Scalar>
Mat3<S> skew(const Eigen::MatrixBase<D>& vector) {
  const Vec3<S> r = vector;
  Mat3<S> X;
  X << S(0), -r.z(), r.y(), r.z(), S(0), -r.x(), -r.y(), r.x(), S(0);
  return X;
}

/// Motion vectors from frame A to frame B, where B sits at `p_AB` with axes `R_AB` in A.
/// [RBDA] (2.24) with E = R_AB^T and r = p_AB.
template <class S>
Matrix6<S> plucker(const Mat3<S>& R_AB, const Vec3<S>& p_AB) {
  const Mat3<S> E = R_AB.transpose();
  Matrix6<S> X;
  X << E, Mat3<S>::Zero(), -E * skew(p_AB), E;
  return X;
}

/// v x for motion vectors.  [RBDA] (2.31)
template <class S>
Matrix6<S> crm(const Vector6<S>& v) {
  const Mat3<S> w = skew(v.template head<3>());
  Matrix6<S> X;
  X << w, Mat3<S>::Zero(), skew(v.template tail<3>()), w;
  return X;
}

/// v x* for force vectors.  [RBDA] (2.32)
template <class S>
Matrix6<S> crf(const Vector6<S>& v) {
  return -crm(v).transpose();
}

/// Inertia of a rigid body with centre of mass c and rotational inertia Ic about it.  [RBDA] (2.63)
template <class S>
Matrix6<S> rigid_inertia(S m, const Vec3<S>& c, const Mat3<S>& Ic) {
  const Mat3<S> cx = skew(c);
  Matrix6<S> I;
  I << Ic + m * cx * cx.transpose(), m * cx, m * cx.transpose(), m * Mat3<S>::Identity();
  return I;
}

/// Between angular first, as inside the engine, and linear first, as at its interface.
template <class S>
Vector6<S> swapped(const Vector6<S>& v) {
  Vector6<S> result;
  result << v.template tail<3>(), v.template head<3>();
  return result;
}

}  // namespace arboc::spatial6

// Spatial vectors as plain six-vectors and 6x6 matrices, angular part first.
//
// Everything as [RBDA] chapter 2 writes it and nothing made fast: a transform is a full 6x6
// matrix, so that each line of the algorithms is a line of the book.
#pragma once
#include <Eigen/Core>

namespace arboc::spatial6 {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// The matrix of r x.  [RBDA] (2.23)
inline Eigen::Matrix3d skew(const Eigen::Vector3d& r) {
  return (Eigen::Matrix3d() << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0).finished();
}

/// Motion vectors from frame A to frame B, where B sits at `p_AB` with axes `R_AB` in A.
/// [RBDA] (2.24) with E = R_AB^T and r = p_AB.
inline Matrix6 plucker(const Eigen::Matrix3d& R_AB, const Eigen::Vector3d& p_AB) {
  const Eigen::Matrix3d E = R_AB.transpose();
  Matrix6 X;
  X << E, Eigen::Matrix3d::Zero(), -E * skew(p_AB), E;
  return X;
}

/// v x for motion vectors.  [RBDA] (2.31)
inline Matrix6 crm(const Vector6& v) {
  const Eigen::Matrix3d w = skew(v.head<3>());
  Matrix6 X;
  X << w, Eigen::Matrix3d::Zero(), skew(v.tail<3>()), w;
  return X;
}

/// v x* for force vectors.  [RBDA] (2.32)
inline Matrix6 crf(const Vector6& v) { return -crm(v).transpose(); }

/// Inertia of a rigid body with centre of mass c and rotational inertia Ic about it.  [RBDA] (2.63)
inline Matrix6 rigid_inertia(double m, const Eigen::Vector3d& c, const Eigen::Matrix3d& Ic) {
  const Eigen::Matrix3d cx = skew(c);
  Matrix6 I;
  I << Ic + m * cx * cx.transpose(), m * cx, m * cx.transpose(), m * Eigen::Matrix3d::Identity();
  return I;
}

}  // namespace arboc::spatial6

// The model's small vectors and matrices as Eigen's.
#pragma once
#include <Eigen/Core>

#include "spatial/matrix3.h"

namespace arboc {

inline Eigen::Vector3d to_eigen(const Vector3<double>& a) { return {a.x, a.y, a.z}; }

inline Eigen::Matrix3d to_eigen(const Matrix3<double>& A) {
  Eigen::Matrix3d B;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) B(i, j) = A(i, j);
  return B;
}

inline Eigen::Matrix3d to_eigen(const Symmetric3<double>& A) { return to_eigen(full(A)); }

}  // namespace arboc

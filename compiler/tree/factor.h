// A rotation as Rz(gamma) Rx(alpha) Rz(theta), by square roots and divisions only.
//
// No angle is formed, so the factors of a signed permutation are exact quarter turns and the
// constants are the same on every machine.
#pragma once
#include "tree/dynamic_tree.h"

namespace arboc {

struct Factors {
  Turn gamma, alpha, theta;
};

/// sin(alpha) >= 0; gamma is the identity where z stays on the z axis.
Factors factor(const Matrix3<double>& R);

/// The product of the factors.
Matrix3<double> rotation(const Factors& factors);

}  // namespace arboc

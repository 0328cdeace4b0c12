// Inertial parameters: from a link as written, moved between frames, added up.
#pragma once
#include "model/model.h"
#include "tree/dynamic_tree.h"

namespace arboc {

/// About the origin of the link's frame and in its axes.
MassMoments mass_moments(const Inertial& inertial);

/// Parameters given in frame B as seen in frame A, x_A = R x_B + p: with k = R h
///   m' = m,  h' = k + m p,  Sigma' = R Sigma R^T + k p^T + p k^T + m p p^T.
MassMoments move(const MassMoments& moments, const Matrix3<double>& R, const Vector3<double>& p);

/// Both in the same frame.
MassMoments operator+(const MassMoments& a, const MassMoments& b);

}  // namespace arboc

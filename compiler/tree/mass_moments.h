// Inertial parameters: from a link as written, moved between frames, added up.
#pragma once
#include "model/model.h"
#include "tree/tallied.h"

namespace arboc {

/// About the origin of the link's frame and in its axes.
MassMoments mass_moments(const Inertial& inertial);

/// Parameters given in frame B as seen in frame A, x_A = R x_B + p: with k = R h
///   m' = m,  h' = k + m p,  Sigma' = R Sigma R^T + k p^T + p k^T + m p p^T.
MassMoments move(const MassMoments& moments, const Matrix3<double>& R, const Vector3<double>& p);

template <class S>
MassMomentsOf<S> move(const MassMomentsOf<S>& moments, const Matrix3<double>& R,
                      const Vector3<S>& p) {
  const Vector3<S> k = place(R, moments.h, Vector3<S>{});
  const Vector3<S> mp = moments.m * p;
  const Symmetric3<S> turned = congruence(cast<S>(R), moments.Sigma);
  return {moments.m, k + mp,
          turned + Symmetric3<S>{(mp.x + S(2) * k.x) * p.x, (mp.y + S(2) * k.y) * p.y,
                                 (mp.z + S(2) * k.z) * p.z, mp.x * p.y + (k.x * p.y + k.y * p.x),
                                 mp.x * p.z + (k.x * p.z + k.z * p.x),
                                 mp.y * p.z + (k.y * p.z + k.z * p.y)}};
}

/// Both in the same frame.
MassMoments operator+(const MassMoments& a, const MassMoments& b);
template <class S>
MassMomentsOf<S> operator+(const MassMomentsOf<S>& a, const MassMomentsOf<S>& b) {
  return {a.m + b.m, a.h + b.h, a.Sigma + b.Sigma};
}

}  // namespace arboc

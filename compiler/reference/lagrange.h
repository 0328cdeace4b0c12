// The equations of motion in Lagrange's form, from 4x4 transforms and pseudo-inertia matrices.
//
// [Thesis] chapter 4 as it stands: with T_j from the world to link j, dT, d2T its derivatives in
// the coordinates and J_j the 4x4 pseudo-inertia of the link,
//     K = 1/2 sum_j sum_k sum_i Tr(dT_k J_j dT_i^T) v_k v_i                              (4.24),
//     (4.26) tau_i = sum_j Tr{ (sum_k dT_k a_k + sum_k sum_m d2T_km v_k v_m) J_j dT_i^T }
//             - sum_j m_j g^T dT_i c_j                                                      (4.28)
// There are no velocities of bodies, no recursion and no spatial vectors in it, so that it shares
// neither formulation nor mistakes with inverse dynamics by Newton and Euler, which it tests.
// O(n^3) a link.  Joints have one coordinate each: a Model with others is to be expanded first,
// because Lagrange's equations are of coordinates and their own derivatives.
#pragma once
#include "reference/transforms.h"

namespace arboc {

/// (4.25): the second moments of a link's mass in the frame of the link, the integral of (r, 1)
/// (r, 1)^T dm.  Positive semidefinite exactly if some distribution of mass has this inertia.
Eigen::Matrix4d pseudo_inertia(const Inertial& inertial);

template <class S>
class LagrangianOf {
 public:
  using Vector = VectorOf<S>;
  using Matrix = MatrixOf<S>;

  /// `model` is configured.  Throws std::invalid_argument that names a joint of several
  /// coordinates.
  explicit LagrangianOf(const Model& model);

  int nv() const { return reference_.nv(); }

  /// What the equations consist of, tau = D a + C v + c, at a state.
  struct Terms {
    Matrix D;  ///< nv x nv, inertia
    Matrix C;  ///< nv x nv: C_ik = sum_m [km, i] v_m with Christoffel's symbols of the first kind
    Vector c;  ///< nv, gravity
  };
  Terms terms(const Vector& q, const Vector& v) const;
  /// h = C v.
  Vector tau(const Vector& q, const Vector& v, const Vector& a) const;

  /// K, by (4.24), and P, by (4.21) and (4.22), J.
  S kinetic(const Vector& q, const Vector& v) const;
  S potential(const Vector& q) const;

  /// 6 x nv: of the point `r` (m, link's frame) and of the link, along the world's axes, linear
  /// first, by (4.10) and (4.11) from the axes of the joints.
  Matrix jacobian(const Vector& q, int link, const Eigen::Vector3d& r) const;

 private:
  struct Mass {
    int link;
    Eigen::Matrix4d J;
  };

  ReferenceOf<S> reference_;  ///< for the placements of its links only
  std::vector<Mass> masses_;
  Eigen::Vector4d gravity_;
};

using Lagrangian = LagrangianOf<double>;

}  // namespace arboc

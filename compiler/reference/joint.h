// What a joint does, by its type: where it puts the child, and how the child can move.
//
// This is jcalc of [RBDA] section 4.4, with two liberties of the public interface: rates are
// always in the child's frame (so S is constant and c_J = 0 for every type), and columns are
// ordered linear before angular.  On double and on Complex.
#pragma once
#include <Eigen/Core>
#include <type_traits>

#include "model/model.h"
#include "reference/scalar.h"
#include "reference/spatial6.h"

namespace arboc {

template <class S>
using VectorOf = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <class S>
using MatrixOf = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// Pose of a frame B in a frame A.
template <class S>
struct PlacementOf {
  spatial6::Mat3<S> R = spatial6::Mat3<S>::Identity();  ///< R_AB
  spatial6::Vec3<S> p = spatial6::Vec3<S>::Zero();      ///< p_AB, m
};
using Placement = PlacementOf<double>;

/// T_AC of T_AB and T_BC.
template <class S>
PlacementOf<S> operator*(const PlacementOf<S>& AB, const PlacementOf<S>& BC) {
  return {AB.R * BC.R, AB.p + AB.R * BC.p};
}

/// Pose of the child's frame relative to where it is at q = 0; `q` holds nq(type) entries.
template <class S>
PlacementOf<S> joint_placement(const Joint& joint, const VectorOf<S>& q);

/// S: the child's velocity relative to its parent is S v, in the child's frame; 6 x nv(type), rows
/// angular first.
Eigen::MatrixXd motion_subspace(const Joint& joint);

/// q moved by the tangent vector `dv` (nv(type) entries, body frame): the pose becomes
/// pose * exp(dv) with the exponential of SE(3) for a floating joint, of SO(3) for a spherical and
/// of SE(2) for a planar one, and an unbounded one turns; a sum for the others.  A quaternion stays
/// a unit up to rounding.
template <class S>
VectorOf<S> integrate_joint(const Joint& joint, const VectorOf<S>& q,
                            const std::type_identity_t<VectorOf<S>>& dv);

/// The dv with integrate_joint(q0, dv) = q1 (of a quaternion up to its sign); of a floating,
/// spherical or unbounded joint the one that turns by less than pi.  Angles are not wrapped: 2 pi
/// is a turn.  Not finite for a planar joint that moves and turns by a multiple of 2 pi, which no
/// dv does.
template <class S>
VectorOf<S> joint_difference(const Joint& joint, const VectorOf<S>& q0, const VectorOf<S>& q1);

}  // namespace arboc

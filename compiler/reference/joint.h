// What a joint does, by its type: where it puts the child, and how the child can move.
//
// This is jcalc of [RBDA] section 4.4, with two liberties of the public interface: rates are
// always in the child's frame (so S is constant and c_J = 0 for every type), and columns are
// ordered linear before angular.
#pragma once
#include <Eigen/Core>

#include "model/model.h"
#include "reference/spatial6.h"

namespace arboc {

/// Pose of a frame B in a frame A.
struct Placement {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< R_AB
  Eigen::Vector3d p = Eigen::Vector3d::Zero();      ///< p_AB, m
};

/// Rotation by `angle` (rad) about the unit vector `axis`.
Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double angle);

/// Pose of the child's frame relative to where it is at q = 0; `q` holds nq(type) entries.
Placement joint_placement(const Joint& joint, const Eigen::VectorXd& q);

/// S: the child's velocity relative to its parent is S v, in the child's frame; 6 x nv(type), rows
/// angular first.
Eigen::MatrixXd motion_subspace(const Joint& joint);

/// q moved by the tangent vector `dv` (nv(type) entries, body frame): the pose becomes
/// pose * exp(dv) with the exponential of SE(3) for a floating joint and of SE(2) for a planar
/// one; a sum for the others.  A quaternion stays a unit up to rounding.
Eigen::VectorXd integrate_joint(const Joint& joint, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& dv);

}  // namespace arboc

// How frames of links move: velocities, accelerations, Jacobians, in three kinds of axes.
//
// Six-vectors are linear before angular.  Everything called a rate is the derivative, component by
// component, of coordinates in the same axes: acceleration = J a + (dJ/dt) v.  So it is
//   kLocal    the derivative of the velocity's components along the link's own turning axes,
//   kWorld    the spatial acceleration at the world's origin ([RBDA] section 2.10),
//   kAligned  that of the frame's origin, d^2 p / dt^2, and the angular one, along world axes.
// Gravity is no part of it.  `link` is an index into Model::links.
#pragma once
#include "reference/reference.h"

namespace arboc {

template <class S>
using Matrix6XOf = Eigen::Matrix<S, 6, Eigen::Dynamic>;

template <class S>
spatial6::Vector6<S> frame_velocity(const ReferenceOf<S>& reference, const VectorOf<S>& q,
                                    const VectorOf<S>& v, int link, Axes axes);

template <class S>
spatial6::Vector6<S> frame_acceleration(const ReferenceOf<S>& reference, const VectorOf<S>& q,
                                        const VectorOf<S>& v, const VectorOf<S>& a, int link,
                                        Axes axes);

/// J, 6 x nv: frame_velocity = J v.
template <class S>
Matrix6XOf<S> frame_jacobian(const ReferenceOf<S>& reference, const VectorOf<S>& q, int link,
                             Axes axes);

/// dJ/dt, 6 x nv, while q moves with v.
template <class S>
Matrix6XOf<S> frame_jacobian_dot(const ReferenceOf<S>& reference, const VectorOf<S>& q,
                                 const VectorOf<S>& v, int link, Axes axes);

/// 6 x nv: column k is the velocity, at the world's origin and along world axes, that coordinate k
/// gives what it moves; a mimic follower adds multiplier times its own to its leader's column.
template <class S>
Matrix6XOf<S> joint_jacobians(const ReferenceOf<S>& reference, const VectorOf<S>& q);

}  // namespace arboc

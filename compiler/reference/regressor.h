// Inverse dynamics as a linear function of the inertial parameters [Khalil].
//
// A body is a moving joint's child link with all that is welded to it, and has ten parameters about
// the origin of that link's frame, along its axes:
//     m (kg);  m c_x, m c_y, m c_z (kg m);  Ixx Ixy Iyy Ixz Iyz Izz (kg m^2)
// Bodies come in the order of the moving joints in the model, mimic followers among them.
#pragma once
#include "reference/reference.h"

namespace arboc {

/// Y, nv x 10 bodies, with Y body_parameters = rnea(q, v, a) without loads and joint forces.
template <class S>
MatrixOf<S> regressor(const ReferenceOf<S>& reference, const VectorOf<S>& q, const VectorOf<S>& v,
                      const VectorOf<S>& a);

/// The parameters of the model's bodies, ten a body.
Eigen::VectorXd body_parameters(const Model& model);

}  // namespace arboc

// Mass, centre of mass and momentum of all links that move, along world axes.
//
// What is welded to the world is left out.  Where nothing that moves has mass, there is no centre
// of mass, and what needs it is not finite.
#pragma once
#include "reference/frames.h"

namespace arboc {

/// kg.
double moving_mass(const Model& model);

/// Centre of mass (m), its velocity (m/s), and the 3 x nv matrix J with com_velocity = J v.
template <class S>
spatial6::Vec3<S> com(const ReferenceOf<S>& reference, const VectorOf<S>& q);
template <class S>
spatial6::Vec3<S> com_velocity(const ReferenceOf<S>& reference, const VectorOf<S>& q,
                               const VectorOf<S>& v);
template <class S>
Eigen::Matrix<S, 3, Eigen::Dynamic> com_jacobian(const ReferenceOf<S>& reference,
                                                 const VectorOf<S>& q);

/// Linear momentum (kg m/s), then angular momentum about the centre of mass (kg m^2/s).
template <class S>
struct CentroidalOf {
  spatial6::Vector6<S> h;   ///< momentum
  Matrix6XOf<S> A_G;        ///< h = A_G v
  spatial6::Vector6<S> dh;  ///< dh/dt
};

/// The centroidal momentum and its matrix [OG08].
template <class S>
CentroidalOf<S> centroidal(const ReferenceOf<S>& reference, const VectorOf<S>& q,
                           const VectorOf<S>& v, const VectorOf<S>& a);

}  // namespace arboc

// The same motion and torques by the formulas of [Astronaut] section 4: three rigid bodies, spatial
// vectors along the axes of the reference frame, in which the body's momentum is summed.
//
//   v3 = v0 + S1 q1d + S2 q2d + S3 q3d,   v0 = -(I0 + I3 + I6)^-1 [I3 (S1 q1d + ...) + I6 (S4 q4d +
//   ...)] 0 = sum I_i a_i + v_i x* I_i v_i,     f_i = I_i a_i + v_i x* I_i v_i,   tau_i = S_i^T f3
//   or f6
#pragma once
#include <array>

#include "models.h"

namespace self_orientation {

struct Body {
  double mass;
  Eigen::Vector3d centre;   ///< in the body's frame, m
  Eigen::Matrix3d inertia;  ///< about the origin of the body's frame, along its axes, kg m^2
};

/// Torso and legs, found from mass matrix and placements with straight legs, as [Astronaut]
/// section 4 describes them: the torso's frame in its centre of mass, legs in frames at the hips
/// whose axes are the torso's then.
struct ThreeBodies {
  std::array<Body, 3> bodies;           ///< torso, right leg, left leg
  std::array<Eigen::Vector3d, 2> hips;  ///< in the torso's frame
};
/// Throws std::logic_error where the mass matrix with bent legs is not that of such bodies.
ThreeBodies three_bodies(const Model& model);

struct PaperMotion {
  Vector6 v0, a0;  ///< along the torso's axes, as `v` and `a` of the base
  Vector6 torques;
  Vector6 wrenches;  ///< f0 + f3 + f6: the rate of momentum
};
/// At a state whose joints move as v and a say; the base's parts of v and a are not looked at.
PaperMotion paper_motion(const ThreeBodies& body, const Vector& q, const Vector& v,
                         const Vector& a);

}  // namespace self_orientation

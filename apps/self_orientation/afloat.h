// How the base of a body afloat moves while its joints move, nothing outside touching it.
//
// Momentum is and stays zero ([Astronaut] section 4): of h = A_b v_b + A_j qd the base's velocity
// follows, of dh = 0 its acceleration.  Neither depends on where the base is, so that placements
// are a linear differential equation on SE(3), T' = T [v_b(t)], which is integrated by a Magnus
// expansion of sixth order: rotations stay rotations.
#pragma once
#include "manoeuvre.h"

namespace self_orientation {

struct BaseMotion {
  Vector6 velocity, acceleration;  ///< along the base's axes
};

/// `q`: of all coordinates; rates of joints.
Vector6 base_velocity(const Model& model, const Vector& q, const Vector& qd);
BaseMotion base_motion(const Model& model, const Vector& q, const Vector& qd, const Vector& qdd);

/// The motion of the base between two instants of one step, as the argument of `integrate`:
/// q(t1) = integrate(q(t0), ...), to O((t1 - t0)^7).
Vector6 magnus(const Model& model, const Manoeuvre& manoeuvre, std::size_t step, double t0,
               double t1);

/// Frames at `rate`, the ends of steps among the instants of integration.
struct Trajectory {
  std::vector<double> times;
  std::vector<Vector> q, v, a;  ///< of all coordinates
};
Trajectory simulate(const Model& model, const Manoeuvre& manoeuvre, double rate);

/// How the trunk has turned at the end, along its axes at the start, by `intervals` of each step.
Eigen::Matrix3d final_turn(const Model& model, const Manoeuvre& manoeuvre, int intervals);

/// Of the trunk, the first of the model's frames, in the world.
Eigen::Matrix3d orientation(const Model& model, const Vector& q);
/// Turn about the trunk's axis `up`, and how far off it is then.
struct Heading {
  double turn, tilt;  ///< rad
};
Heading heading(const Eigen::Matrix3d& R, int up);

}  // namespace self_orientation

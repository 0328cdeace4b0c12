// Which of the forces that joints exert by themselves are part of the dynamics.
#pragma once

namespace arboc {

/// Which of the fields of model::Joint act.  Each joint adds, by its own q, v and a (a mimic
/// follower by its own too, and its leader feels multiplier times the force),
///
///     damping v + friction v / sqrt(v^2 + friction_velocity^2) + stiffness (q - neutral)
///       + rotor_inertia a
///
/// to the force that its motion takes.  Of joints with several coordinates every one is damped,
/// rubs and has a rotor, and there are no springs.
struct JointForces {
  bool damping = false;
  bool friction = false;
  bool stiffness = false;
  bool rotor = false;
  double friction_velocity = 0.01;  ///< rad/s or m/s; friction is smooth below it

  bool any() const { return damping || friction || stiffness || rotor; }
};

}  // namespace arboc

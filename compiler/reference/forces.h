// Forces beyond weight and inertia: wrenches on links, and what joints do of themselves.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "model/model.h"

namespace arboc {

/// What acts on a link from outside.
struct LinkWrench {
  int link = -1;  ///< index into Model::links
  /// Where moments are taken about, and along which axes: of the link's frame.
  Axes axes = Axes::kLocal;
  Eigen::Matrix<double, 6, 1> wrench;  ///< force, N, then moment, N m
};
using Loads = std::vector<LinkWrench>;

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
};

}  // namespace arboc

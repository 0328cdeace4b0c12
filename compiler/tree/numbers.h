// The numbers of a model that the dynamic tree keeps: lengths, inertial parameters, gravity.
#pragma once
#include <vector>

#include "model/joint_forces.h"
#include "model/model.h"
#include "tree/mass_moments.h"

namespace arboc {

/// In the model's own frames and order; S is double, or Expr where parameters take their place.
template <class S>
struct NumbersOf {
  Vector3<S> gravity;                     ///< m/s^2, world axes
  std::vector<Vector3<S>> origin;         ///< per joint xyz of its placement, m
  std::vector<MassMomentsOf<S>> moments;  ///< per link, about its origin and in its axes
  std::vector<JointForcesOf<S>> forces;   ///< per joint; none: empty
  double friction_velocity = 0.01;        ///< rad/s or m/s
};

/// As written, of the joints' own forces those that `forces` names.
NumbersOf<double> numbers(const Model& model, const JointForces& forces = {});

}  // namespace arboc

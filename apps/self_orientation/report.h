// What a manoeuvre comes to: heading, how well momentum is kept, torques, energy.
#pragma once
#include <map>
#include <optional>

#include "afloat.h"
#include "common/expenditure.h"

namespace self_orientation {

/// Largest differences between the formulas of [Astronaut] and floating-base dynamics.
struct PaperDifference {
  double velocity = 0;       ///< of v0; m/s, rad/s
  double acceleration = 0;   ///< of a0; m/s^2, rad/s^2
  double torque = 0;         ///< N m
  double momentum_rate = 0;  ///< |f0 + f3 + f6|; N, N m
};

struct Result {
  double heading = 0, tilt = 0;  ///< rad, of the base at the end
  double momentum_drift = 0;  ///< largest |h| over the largest |A_j qd|: of what joints alone have
  double com_drift = 0;       ///< m
  double base_residual = 0;   ///< largest force or moment on the base; N, N m
  double closure = 0;         ///< rad: joints at the end from the start
  double power_balance = 0;   ///< W: dT/dt - sum tau qd
  std::map<std::string, double> energy;  ///< the five measures over the motion
  std::optional<PaperDifference> paper;
  std::vector<study::Peak> peaks;  ///< one a joint
  Trajectory trajectory;
  study::Rows torques;  ///< frames x joints
  Vector weighted;      ///< sum of |tau|, a third where joints give way, N m
  double seconds = 0;   ///< of simulation and torques
};

Result report(const Model& model, const Task& task);

}  // namespace self_orientation

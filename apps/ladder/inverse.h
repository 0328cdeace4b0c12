// Joint angles for a place of the torso and of both hands, and their rates; [Astronaut] section 5.
#pragma once
#include <stdexcept>

#include "body.h"

namespace ladder {

/// Where the torso is, and how it moves: upright but for pitch, in the sagittal plane.
struct TorsoState {
  Torso at;                           ///< the shoulders from the right hand
  double vx = 0, vz = 0, vpitch = 0;  ///< m/s, rad/s
  double ax = 0, az = 0, apitch = 0;  ///< m/s^2, rad/s^2
};

struct State {
  Joints q, v, a;
};

/// Out of reach, or out of the limits of a joint; says which.
struct NoPosture : std::domain_error {
  using std::domain_error::domain_error;
};

/// `hand`: of the left from the right, m.  Each arm is a chain of two links in a plane, whose elbow
/// bends either way; Gauss-Newton steps on the whole chain then take out what the plane leaves.
/// `legs`: of the last three joints.  Throws NoPosture.
Joints inverse(const Torso& torso, const Vector3& hand, const std::array<int, 2>& elbows,
               const Vector3& legs);

/// Rates and accelerations with both hands at rest on their bars, legs held.
State moving(const Joints& q, const TorsoState& torso);

/// Largest error of the torso's and the left hand's place, m and rad, of q.
double inverse_error(const Joints& q, const Torso& torso, const Vector3& hand);

}  // namespace ladder

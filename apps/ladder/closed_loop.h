// Both hands on bars: a closed chain of bar, arms, torso, arms and bar.
//
// The tree at the right hand is cut at the left grip, and a wrench there, the multiplier lambda of
// the condition that the hand stays, closes it:  tau = M a + nle - J^T lambda,  J v = 0,  J a + J'
// v = 0. Torques are not unique: six of ten are enough.  lambda is that of the least sum of tau^2.
#pragma once
#include "inverse.h"

namespace ladder {

using Wrench = Eigen::Matrix<double, 6, 1>;

struct Closed {
  State state;
  Joints tau;         ///< with lambda
  Joints tau_open;    ///< if only the right hand held
  Wrench lambda;      ///< on the left hand, world axes; N, N m
  double hand_error;  ///< of the left hand's place; m, rad
  double hand_speed;  ///< |J v|; m/s, rad/s
};
/// The torso as `torso` says, from the right hand; `hand`: of the left from the right.
Closed closed(const TorsoState& torso, const Vector3& hand, const std::array<int, 2>& elbows,
              const Vector3& legs);

/// Forward dynamics of the closed chain: accelerations and lambda of given torques, of
/// [M J^T; J 0] [a; -lambda] = [tau - nle; -J' v].
struct ClosedForward {
  Joints a;
  Wrench lambda;
};
ClosedForward closed_forward(const Joints& q, const Joints& v, const Joints& tau);

}  // namespace ladder

#include "inverse.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <cmath>

namespace ladder {
namespace {

using Twelve = Eigen::Matrix<double, 12, 1>;
using Rows12 = Eigen::Matrix<double, 12, kArms>;

constexpr double kDegree = 3.14159265358979323846 / 180;

/// Pitches of forearm and upper arm, for the shoulder at (x, z) from the hand.
struct Arm {
  double forearm, upper_arm;
};
Arm arm(double x, double z, int branch, const char* side) {
  const Lengths& l = lengths();
  const double f = l.forearm, u = l.upper_arm;
  const double c = (x * x + z * z - f * f - u * u) / (2 * f * u);
  if (!(std::fabs(c) <= 1))
    throw NoPosture(
        fmt::format("the {} hand is {:.3f} m from its shoulder; an arm reaches from {:.3f} to "
                    "{:.3f} m",
                    side, std::hypot(x, z), std::fabs(f - u), f + u));
  // A limb of pitch p points from the hand along (-cos p, sin p).
  const double bend = branch * std::acos(c), along = std::atan2(z, -x);
  const double forearm = along - std::atan2(u * std::sin(bend), f + u * std::cos(bend));
  return {forearm, forearm + bend};
}

Eigen::Matrix3d rotation(const double* placement) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(placement);
}

/// Of a frame from where it is to be: position, and rotation as a vector.
Eigen::Matrix<double, 6, 1> error(const double* placement, const Vector3& p,
                                  const Eigen::Matrix3d& R) {
  Eigen::Matrix<double, 6, 1> out;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(R * rotation(placement).transpose()));
  out << p - Vector3(placement + 9), turn.angle() * turn.axis();
  return out;
}

Twelve error(const Joints& q, const Torso& torso, const Vector3& hand) {
  double at[12 * kFrames];
  tree(kRight).fk(q, at);
  Twelve out;
  out << error(at + 12 * kTorso, {torso.x, 0, torso.z},
               Eigen::AngleAxisd(torso.pitch, Vector3::UnitY()).toRotationMatrix()),
      error(at + 12 * kLeftHand, hand, Eigen::Matrix3d::Identity());
  return out;
}

/// Of torso and left hand by the joints between the hands.
Rows12 jacobian(const Joints& q) {
  Eigen::Matrix<double, 6 * kFrames, kJoints> all;
  tree(kRight).jacobian(q, all.data());
  Rows12 out;
  out << all.block<6, kArms>(6 * kTorso, 0), all.block<6, kArms>(6 * kLeftHand, 0);
  return out;
}

void check_limits(const Joints& q) {
  const Tree& t = tree(kRight);
  for (int j = 0; j < kJoints; ++j)
    if (q[j] < t.q_lower[j] - 1e-12 || q[j] > t.q_upper[j] + 1e-12)
      throw NoPosture(fmt::format("{} would be at {:.1f} deg; its limits are {:.1f} and {:.1f}",
                                  t.joints[static_cast<std::size_t>(j)], q[j] / kDegree,
                                  t.q_lower[j] / kDegree, t.q_upper[j] / kDegree));
}

}  // namespace

Joints inverse(const Torso& torso, const Vector3& hand, const std::array<int, 2>& elbows,
               const Vector3& legs) {
  const Arm right = arm(torso.x, torso.z, elbows[kRight], "right");
  const Arm left = arm(torso.x - hand[0], torso.z - hand[2], elbows[kLeft], "left");
  Joints q = Joints::Zero();
  q[joint("r_wrist.y")] = right.forearm;
  q[joint("r_elbow")] = right.upper_arm - right.forearm;
  q[joint("r_shoulder.y")] = torso.pitch - right.upper_arm;
  q[joint("l_shoulder.y")] = left.upper_arm - torso.pitch;
  q[joint("l_elbow")] = left.forearm - left.upper_arm;
  q[joint("l_wrist.y")] = -left.forearm;
  q.tail<3>() = legs;
  for (int step = 0; step < 30; ++step) {
    const Twelve e = error(q, torso, hand);
    if (e.cwiseAbs().maxCoeff() < 1e-13) break;
    q.head<kArms>() += jacobian(q).completeOrthogonalDecomposition().solve(e);
  }
  const double left_over = inverse_error(q, torso, hand);
  if (!(left_over < 1e-10))
    throw NoPosture(fmt::format(
        "torso and hands cannot be there together: {:.2g} m or rad are left", left_over));
  check_limits(q);
  return q;
}

double inverse_error(const Joints& q, const Torso& torso, const Vector3& hand) {
  return error(q, torso, hand).cwiseAbs().maxCoeff();
}

State moving(const Joints& q, const TorsoState& torso) {
  State s{q, Joints::Zero(), Joints::Zero()};
  const Eigen::CompleteOrthogonalDecomposition<Rows12> J(jacobian(q));
  Twelve wanted = Twelve::Zero();
  wanted[0] = torso.vx, wanted[2] = torso.vz, wanted[4] = torso.vpitch;
  s.v.head<kArms>() = J.solve(wanted);
  Eigen::Matrix<double, 6, kFrames> bias;
  tree(kRight).acceleration(q, s.v, s.a, bias.data());
  wanted.setZero();
  wanted[0] = torso.ax, wanted[2] = torso.az, wanted[4] = torso.apitch;
  wanted.head<6>() -= bias.col(kTorso);
  wanted.tail<6>() -= bias.col(kLeftHand);
  s.a.head<kArms>() = J.solve(wanted);
  return s;
}

}  // namespace ladder

#include "closed_loop.h"

#include <Eigen/LU>
#include <Eigen/QR>

namespace ladder {
namespace {

using HandRows = Eigen::Matrix<double, 6, kJoints>;

HandRows left_hand(const Joints& q) {
  Eigen::Matrix<double, 6 * kFrames, kJoints> all;
  tree(kRight).jacobian(q, all.data());
  return all.middleRows<6>(6 * kLeftHand);
}

Joints inverse_dynamics(const State& s) {
  Vector tau;
  tree(kRight).rnea(s.q, s.v, s.a, tau);
  return tau;
}

}  // namespace

Closed closed(const TorsoState& torso, const Vector3& hand, const std::array<int, 2>& elbows,
              const Vector3& legs) {
  Closed out;
  const Joints q = inverse(torso.at, hand, elbows, legs);
  out.state = moving(q, torso);
  out.hand_error = inverse_error(q, torso.at, hand);
  const HandRows J = left_hand(q);
  out.hand_speed = (J * out.state.v).cwiseAbs().maxCoeff();
  out.tau_open = inverse_dynamics(out.state);
  out.lambda = J.transpose().eval().completeOrthogonalDecomposition().solve(out.tau_open);
  out.tau = out.tau_open - J.transpose() * out.lambda;
  return out;
}

ClosedForward closed_forward(const Joints& q, const Joints& v, const Joints& tau) {
  const Tree& t = tree(kRight);
  const HandRows J = left_hand(q);
  const State still{q, v, Joints::Zero()};
  Eigen::Matrix<double, 6, kFrames> bias;
  t.acceleration(q, v, still.a, bias.data());
  constexpr int n = kJoints + 6;
  Eigen::Matrix<double, n, n> K = Eigen::Matrix<double, n, n>::Zero();
  K.topLeftCorner<kJoints, kJoints>() = t.mass_matrix(q);
  K.topRightCorner<kJoints, 6>() = J.transpose();
  K.bottomLeftCorner<6, kJoints>() = J;
  Eigen::Matrix<double, n, 1> right;
  right << tau - inverse_dynamics(still), -bias.col(kLeftHand);
  const Eigen::Matrix<double, n, 1> x = K.fullPivLu().solve(right);
  return {x.head<kJoints>(), -x.tail<6>()};
}

}  // namespace ladder

#include "peer.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <stdexcept>

namespace peers {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Peer::Peer(const Body& body)
    : body_(body),
      joints_(body.joint, body.joint + body.joints),
      links_(body.link, body.link + body.links),
      folder_(body.toolchain.folder),
      compiler_(body.toolchain.compiler),
      flags_(body.toolchain.flags) {
  body_.joint = joints_.data();
  body_.link = links_.data();
  body_.toolchain = {folder_.c_str(), compiler_.c_str(), flags_.c_str()};
}

Peer::Rates Peer::rates(const Joint& joint, const VectorXd&, const VectorXd&) const {
  const int n = nv(joint.kind);
  return {MatrixXd::Identity(n, n), VectorXd::Zero(n)};
}

Peer::Rates Peer::all_rates(const VectorXd& q, const VectorXd& v) const {
  Rates result{MatrixXd::Identity(body_.nv, body_.nv), VectorXd::Zero(body_.nv)};
  for (const Joint& joint : joints_) {
    const int n = nv(joint.kind);
    if (n < 2) continue;
    const Rates own = rates(joint, q.segment(joint.q, nq(joint.kind)), v.segment(joint.v, n));
    result.J.block(joint.v, joint.v, n, n) = own.J;
    result.Jdot_v.segment(joint.v, n) = own.Jdot_v;
  }
  return result;
}

Peer::Rates Peer::parent_axes(const Joint& joint, const VectorXd& q, const VectorXd& v) {
  const int n = nv(joint.kind);
  Rates result{MatrixXd::Identity(n, n), VectorXd::Zero(n)};
  if (joint.kind == Kind::kPlanar) {
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(q[2]).toRotationMatrix();
    result.J.topLeftCorner<2, 2>() = R;
    result.Jdot_v.head<2>() = R * Eigen::Vector2d(-v[2] * v[1], v[2] * v[0]);
  } else {
    const Eigen::Matrix3d R = Eigen::Quaterniond(q[6], q[3], q[4], q[5]).toRotationMatrix();
    result.J.topLeftCorner<3, 3>() = R;
    result.Jdot_v.head<3>() = R * Eigen::Vector3d(v.tail<3>()).cross(Eigen::Vector3d(v.head<3>()));
  }
  return result;
}

State Peer::to_peer(const State& ours) const {
  const Rates own = all_rates(ours.q, ours.v);
  State x{ours.q, own.J * ours.v, own.J * ours.a + own.Jdot_v, {}};
  x.tau = own.J.transpose().partialPivLu().solve(ours.tau);
  return converted(x);
}

Outputs Peer::evaluate(Function f, const State& ours) {
  run(f, to_peer(ours));
  Outputs out = outputs(f);
  const Rates own = all_rates(ours.q, ours.v);
  switch (f) {
    case Function::kRnea: out[0] = own.J.transpose() * out[0]; break;
    case Function::kCrba: out[0] = own.J.transpose() * out[0] * own.J; break;
    case Function::kAba: {
      const VectorXd a = out[0] - own.Jdot_v;  // apart: solve() writes while it reads
      out[0] = own.J.partialPivLu().solve(a);
      break;
    }
    default:
      if (!own.J.isIdentity(0)) throw std::logic_error("derivatives in other rates");
  }
  return out;
}

}  // namespace peers

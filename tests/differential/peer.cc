#include "differential/peer.h"

#include <Eigen/Geometry>

namespace arboc::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Peer::Peer(const Model& model) : model_(model) {
  const Coordinates given = coordinates(model);
  for (Joint& joint : model_.joints) joint.mimic.reset();
  where_ = coordinates(model_);
  follow_q_ = MatrixXd::Zero(where_.nq, given.nq);
  follow_v_ = MatrixXd::Zero(where_.nv, given.nv);
  offset_ = VectorXd::Zero(where_.nq);
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Coordinates::Entry &own = where_.joint[k], &leader = given.joint[k];
    const JointType type = model.joints[k].type;
    for (int i = 0; i < nq(type); ++i) {
      follow_q_(own.q + i, leader.q + i) = leader.multiplier;
      offset_[own.q + i] = leader.offset;
    }
    for (int i = 0; i < nv(type); ++i) follow_v_(own.v + i, leader.v + i) = leader.multiplier;
  }
}

Peer::Rates Peer::all_rates(const VectorXd& q, const VectorXd& v) const {
  Rates result{MatrixXd::Identity(where_.nv, where_.nv), VectorXd::Zero(where_.nv)};
  for (size_t k = 0; k < model_.joints.size(); ++k) {
    const Joint& joint = model_.joints[k];
    const int n = nv(joint.type);
    if (n < 2) continue;
    const Coordinates::Entry& at = where_.joint[k];
    const Rates own = rates(joint, q.segment(at.q, nq(joint.type)), v.segment(at.v, n));
    result.J.block(at.v, at.v, n, n) = own.J;
    result.Jdot_v.segment(at.v, n) = own.Jdot_v;
  }
  return result;
}

Peer::Rates Peer::parent_axes(const Joint& joint, const VectorXd& q, const VectorXd& v) {
  const int n = nv(joint.type);
  Rates result{MatrixXd::Identity(n, n), VectorXd::Zero(n)};
  if (joint.type == JointType::kPlanar) {
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

VectorXd Peer::rnea(const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  const VectorXd q_freed = freed(q), v_freed = follow_v_ * v, a_freed = follow_v_ * a;
  const Rates own = all_rates(q_freed, v_freed);
  const VectorXd tau = peer_rnea(q_freed, own.J * v_freed, own.J * a_freed + own.Jdot_v);
  return follow_v_.transpose() * (own.J.transpose() * tau);
}

MatrixXd Peer::crba(const VectorXd& q) {
  const VectorXd q_freed = freed(q);
  const MatrixXd G = all_rates(q_freed, VectorXd::Zero(where_.nv)).J * follow_v_;
  return G.transpose() * peer_crba(q_freed) * G;
}

const std::vector<PeerKind>& peers() {
  static const std::vector<PeerKind> kPeers = {
#ifdef ARBOC_HAVE_DART
      {"DART", 1e-12, "rounding of sums over the tree", make_dart},
#endif
#ifdef ARBOC_HAVE_KDL
      {"KDL", 1e-12, "rounding of sums over the tree", make_kdl},
#endif
#ifdef ARBOC_HAVE_MUJOCO
      {"MuJoCo", 2e-6, "it diagonalises inertias, to about seven digits", make_mujoco},
#endif
  };
  return kPeers;
}

}  // namespace arboc::test

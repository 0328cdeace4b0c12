#include "differential/peer.h"

namespace arboc::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Peer::Peer(const Model& model) {
  const Coordinates given = coordinates(model);
  Model freed = model;
  for (Joint& joint : freed.joints) joint.mimic.reset();
  const Coordinates own = coordinates(freed);
  follow_q_ = MatrixXd::Zero(own.nq, given.nq);
  follow_v_ = MatrixXd::Zero(own.nv, given.nv);
  offset_ = VectorXd::Zero(own.nq);
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Coordinates::Entry &to = own.joint[k], &leader = given.joint[k];
    const JointType type = model.joints[k].type;
    for (int i = 0; i < nq(type); ++i) {
      follow_q_(to.q + i, leader.q + i) = leader.multiplier;
      offset_[to.q + i] = leader.offset;
    }
    for (int i = 0; i < nv(type); ++i) follow_v_(to.v + i, leader.v + i) = leader.multiplier;
  }
}

std::unique_ptr<Peer> Peer::make(const Model& model, MakePeer make) {
  const Described described = describe(model);
  std::unique_ptr<Peer> peer(new Peer(model));
  peer->peer_ = make(described.body(model));
  if (!peer->peer_) return nullptr;
  return peer;
}

VectorXd Peer::rnea(const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  const VectorXd none = VectorXd::Zero(follow_v_.rows());
  return follow_v_.transpose() *
         peer_->evaluate(peers::Function::kRnea, {freed(q), follow_v_ * v, follow_v_ * a, none})[0];
}

MatrixXd Peer::crba(const VectorXd& q) {
  const VectorXd none = VectorXd::Zero(follow_v_.rows());
  const MatrixXd M = peer_->evaluate(peers::Function::kCrba, {freed(q), none, none, none})[0];
  return follow_v_.transpose() * M * follow_v_;
}

bool Peer::has_aba() const {
  return follow_v_.rows() == follow_v_.cols() && peer_->has(peers::Function::kAba);
}

VectorXd Peer::aba(const VectorXd& q, const VectorXd& v, const VectorXd& tau) {
  return peer_->evaluate(peers::Function::kAba, {q, v, VectorXd::Zero(v.size()), tau})[0];
}

const std::vector<PeerKind>& peer_kinds() {
  static const std::vector<PeerKind> kKinds = {
#ifdef ARBOC_HAVE_DART
      {"DART", 1e-12, "rounding of sums over the tree", peers::make_dart},
#endif
#ifdef ARBOC_HAVE_KDL
      {"KDL", 1e-12, "rounding of sums over the tree", peers::make_kdl},
#endif
#ifdef ARBOC_HAVE_MUJOCO
      {"MuJoCo", 2e-6, "it diagonalises inertias, to about seven digits", peers::make_mujoco},
#endif
  };
  return kKinds;
}

}  // namespace arboc::test

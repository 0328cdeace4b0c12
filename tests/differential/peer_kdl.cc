// KDL: inverse dynamics of a tree by TreeIdSolver_RNE.
//
// KDL knows only joints with one coordinate and has no inertia matrix for trees.  A floating joint
// becomes three prismatic and three revolute ones and a planar joint two and one, all at zero: the
// pose is put into the constant part and the tree built anew for each configuration, so that no
// angles of the kind that become singular arise.  The inertia's columns are inverse dynamics.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <kdl/tree.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <stdexcept>

#include "differential/peer.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

KDL::Vector kdl(const Vector3<double>& a) { return {a.x, a.y, a.z}; }

KDL::Vector kdl(const Eigen::Vector3d& a) { return {a.x(), a.y(), a.z()}; }

KDL::Frame kdl(const Pose& pose) {
  return {KDL::Rotation::RPY(pose.rpy.x, pose.rpy.y, pose.rpy.z), kdl(pose.xyz)};
}

KDL::JntArray kdl(const VectorXd& x) {
  KDL::JntArray result(static_cast<unsigned>(x.size()));
  result.data = x;
  return result;
}

KDL::RigidBodyInertia kdl(const Link& link) {
  if (!link.inertial) return KDL::RigidBodyInertia::Zero();
  const Symmetric3<double>& I = link.inertial->inertia;
  return kdl(link.inertial->origin) *
         KDL::RigidBodyInertia(link.inertial->mass, KDL::Vector::Zero(),
                               KDL::RotationalInertia(I.xx, I.yy, I.zz, I.xy, I.xz, I.yz));
}

class KdlPeer : public Peer {
 public:
  using Peer::Peer;

 private:
  /// All emulated coordinates are 0, so J = 1; the rotations are about x, then y, then z.
  Rates rates(const Joint& joint, const VectorXd&, const VectorXd& v) const override {
    const int n = nv(joint.type);
    Rates result{MatrixXd::Identity(n, n), VectorXd::Zero(n)};
    if (joint.type == JointType::kPlanar) {
      result.Jdot_v.head<2>() << -v[2] * v[1], v[2] * v[0];
    } else {
      const Vector3d u = v.head<3>(), w = v.tail<3>();
      result.Jdot_v << w.cross(u), -w.y() * w.z(), w.x() * w.z(), -w.x() * w.y();
    }
    return result;
  }

  VectorXd peer_rnea(const VectorXd& q, const VectorXd& v, const VectorXd& a) override {
    if (!constant()) return inverse_dynamics(tree(q), kdl(model().gravity), zero_emulated(q), v, a);
    if (!solver_) {
      tree_ = tree(q);
      solver_ = std::make_unique<KDL::TreeIdSolver_RNE>(tree_, kdl(model().gravity));
    }
    return solve(*solver_, zero_emulated(q), v, a);
  }

  MatrixXd peer_crba(const VectorXd& q) override {
    const int n = where().nv;
    const KDL::Tree built = tree(q);
    const VectorXd position = zero_emulated(q);
    MatrixXd M(n, n);
    for (int j = 0; j < n; ++j)
      M.col(j) = inverse_dynamics(built, KDL::Vector::Zero(), position, VectorXd::Zero(n),
                                  VectorXd::Unit(n, j));
    return M;
  }

  static VectorXd inverse_dynamics(const KDL::Tree& tree, const KDL::Vector& gravity,
                                   const VectorXd& q, const VectorXd& v, const VectorXd& a) {
    KDL::TreeIdSolver_RNE solver(tree, gravity);
    return solve(solver, q, v, a);
  }

  /// No joint is emulated, so one tree serves all configurations.
  bool constant() const {
    return std::all_of(model().joints.begin(), model().joints.end(),
                       [](const Joint& joint) { return nv(joint.type) <= 1; });
  }

  static VectorXd solve(KDL::TreeIdSolver_RNE& solver, const VectorXd& q, const VectorXd& v,
                        const VectorXd& a) {
    KDL::JntArray tau(static_cast<unsigned>(v.size()));
    if (solver.CartToJnt(kdl(q), kdl(v), kdl(a), {}, tau) != 0)
      throw std::runtime_error("KDL: " + std::string(solver.strError(solver.getError())));
    return tau.data;
  }

  /// The coordinates of KDL's joints, as many as v.
  VectorXd zero_emulated(const VectorXd& q) const {
    VectorXd result = VectorXd::Zero(where().nv);
    for (size_t k = 0; k < model().joints.size(); ++k)
      if (nv(model().joints[k].type) == 1) result[where().joint[k].v] = q[where().joint[k].q];
    return result;
  }

  KDL::Tree tree(const VectorXd& q) const {
    KDL::Tree result("world");
    const bool welded = model().joints.empty() || model().joints[0].parent >= 0;
    if (welded)
      result.addSegment(KDL::Segment(link_name(0), KDL::Joint(KDL::Joint::Fixed)), "world");
    for (size_t k = 0; k < model().joints.size(); ++k) {
      const Joint& joint = model().joints[k];
      add_joint(joint, q.segment(std::max(0, where().joint[k].q), nq(joint.type)), result);
    }
    return result;
  }

  void add_joint(const Joint& joint, const VectorXd& q, KDL::Tree& tree) const {
    const KDL::Frame T = kdl(joint.origin);
    const KDL::Vector axis = T.M * kdl(joint.axis);
    switch (joint.type) {
      case JointType::kFixed: return add({KDL::Joint(KDL::Joint::Fixed)}, T, joint, tree);
      case JointType::kRevolute:
      case JointType::kContinuous:
        return add({KDL::Joint(T.p, axis, KDL::Joint::RotAxis)}, T, joint, tree);
      case JointType::kPrismatic:
        return add({KDL::Joint(T.p, axis, KDL::Joint::TransAxis)}, T, joint, tree);
      case JointType::kPlanar: return add_planar(joint, q, tree);
      case JointType::kFloating: return add_floating(joint, q, tree);
      default: throw std::logic_error("no URDF joint");
    }
  }

  void add_planar(const Joint& joint, const VectorXd& q, KDL::Tree& tree) const {
    const Matrix3<double> F = axis_frame(joint.axis);
    const KDL::Vector x = kdl(column(F, 0)), y = kdl(column(F, 1)), z = kdl(joint.axis);
    const KDL::Vector zero = KDL::Vector::Zero();
    const KDL::Frame T =
        kdl(joint.origin) * KDL::Frame(KDL::Rotation::Rot(z, q[2]), x * q[0] + y * q[1]);
    add({KDL::Joint(T.p, T.M * x, KDL::Joint::TransAxis),
         KDL::Joint(zero, y, KDL::Joint::TransAxis), KDL::Joint(zero, z, KDL::Joint::RotAxis)},
        T, joint, tree);
  }

  void add_floating(const Joint& joint, const VectorXd& q, KDL::Tree& tree) const {
    const KDL::Frame T =
        kdl(joint.origin) *
        KDL::Frame(KDL::Rotation::Quaternion(q[3], q[4], q[5], q[6]), kdl(Vector3d(q.head<3>())));
    add({KDL::Joint(T.p, T.M.UnitX(), KDL::Joint::TransAxis), KDL::Joint(KDL::Joint::TransY),
         KDL::Joint(KDL::Joint::TransZ), KDL::Joint(KDL::Joint::RotX), KDL::Joint(KDL::Joint::RotY),
         KDL::Joint(KDL::Joint::RotZ)},
        T, joint, tree);
  }

  /// A chain of KDL joints from the joint's parent to its child.  The first one is written in the
  /// parent's frame and brings the constant part T; only the last one carries the child's inertia.
  void add(const std::vector<KDL::Joint>& chain, const KDL::Frame& T, const Joint& joint,
           KDL::Tree& tree) const {
    std::string parent = joint.parent < 0 ? "world" : link_name(joint.parent);
    for (size_t i = 0; i < chain.size(); ++i) {
      const bool last = i + 1 == chain.size();
      const std::string name =
          last ? link_name(joint.child) : fmt::format("joint{}.{}", joint.child, i);
      tree.addSegment(
          KDL::Segment(name, chain[i], i == 0 ? T : KDL::Frame::Identity(),
                       last ? kdl(model().links[joint.child]) : KDL::RigidBodyInertia::Zero()),
          parent);
      parent = name;
    }
  }

  static std::string link_name(int i) { return fmt::format("link{}", i); }

  KDL::Tree tree_;  ///< the solver refers to it
  std::unique_ptr<KDL::TreeIdSolver_RNE> solver_;
};

}  // namespace

std::unique_ptr<Peer> make_kdl(const Model& model) { return std::make_unique<KdlPeer>(model); }

}  // namespace arboc::test

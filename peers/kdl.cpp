// KDL: inverse dynamics of a tree by TreeIdSolver_RNE; of a chain, with its mass matrix, by the
// solvers of chains, which its users would take.
//
// KDL knows only joints with one coordinate and has no inertia matrix for trees.  A floating joint
// becomes three prismatic and three revolute ones and a planar joint two and one, all at zero: the
// pose is put into the constant part and the tree built anew for each configuration, so that no
// angles of the kind that become singular arise.  The inertia's columns are inverse dynamics then,
// which is not worth timing.
#include <Eigen/Geometry>
#include <algorithm>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>
#include <kdl/tree.hpp>
#include <kdl/treeidsolver_recursive_newton_euler.hpp>
#include <stdexcept>

#include "peer.hpp"

namespace peers {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

KDL::Vector kdl(const Vector3d& a) { return {a.x(), a.y(), a.z()}; }

KDL::Frame kdl(const Joint& joint) {
  const double* R = joint.R;
  return {KDL::Rotation(R[0], R[1], R[2], R[3], R[4], R[5], R[6], R[7], R[8]),
          kdl(vector(joint.p))};
}

KDL::JntArray kdl(const VectorXd& x) {
  KDL::JntArray result(static_cast<unsigned>(x.size()));
  result.data = x;
  return result;
}

KDL::RigidBodyInertia kdl(const Link& link) {
  if (!link.massive) return KDL::RigidBodyInertia::Zero();
  const double* I = link.I;
  // Its rotational inertia is about the link's origin unless the centre is given apart.
  return KDL::Frame(kdl(vector(link.c))) *
         KDL::RigidBodyInertia(link.mass, KDL::Vector::Zero(),
                               KDL::RotationalInertia(I[0], I[1], I[2], I[3], I[4], I[5]));
}

/// Solvers of a chain and what they write to.
struct Chain {
  Chain(const KDL::Chain& given, const KDL::Vector& gravity)
      : chain(given),
        rnea(chain, gravity),
        crba(chain, gravity),
        wrenches(chain.getNrOfSegments()) {}
  KDL::Chain chain;
  KDL::ChainIdSolver_RNE rnea;
  KDL::ChainDynParam crba;
  KDL::Wrenches wrenches;
};

class KdlPeer : public Peer {
 public:
  explicit KdlPeer(const Body& given)
      : Peer(given),
        gravity_(kdl(vector(body().gravity))),
        tau_(static_cast<unsigned>(body().nv)),
        inertia_(static_cast<unsigned>(body().nv)) {
    if (!constant()) return;
    tree_ = tree(VectorXd::Zero(body().nq));
    tree_solver_ = std::make_unique<KDL::TreeIdSolver_RNE>(tree_, gravity_);
    KDL::Chain chain;
    if (branchless() && tree_.getChain("world", link_name(joints().back().child), chain))
      chain_ = std::make_unique<Chain>(chain, gravity_);
  }

  bool has(Function f) const override { return f == Function::kRnea || f == Function::kCrba; }
  bool worth_timing(Function f) const override {
    return has(f) && (chain_ || (constant() && f == Function::kRnea));
  }

  void run(Function f, const State& x) override {
    if (f == Function::kCrba) return run_crba(x.q);
    q_.data = zero_emulated(x.q);
    if (chain_) {
      v_.data = x.v;
      a_.data = x.a;
      check(chain_->rnea.CartToJnt(q_, v_, a_, chain_->wrenches, tau_), chain_->rnea);
    } else if (tree_solver_) {
      tau_.data = solve(*tree_solver_, q_.data, x.v, x.a);
    } else {
      tau_.data = inverse_dynamics(tree(x.q), gravity_, q_.data, x.v, x.a);
    }
  }

 private:
  /// All emulated coordinates are 0, so J = 1; the rotations are about x, then y, then z.
  Rates rates(const Joint& joint, const VectorXd&, const VectorXd& v) const override {
    const int n = nv(joint.kind);
    Rates result{MatrixXd::Identity(n, n), VectorXd::Zero(n)};
    if (joint.kind == Kind::kPlanar) {
      result.Jdot_v.head<2>() << -v[2] * v[1], v[2] * v[0];
    } else {
      const Vector3d u = v.head<3>(), w = v.tail<3>();
      result.Jdot_v << w.cross(u), -w.y() * w.z(), w.x() * w.z(), -w.x() * w.y();
    }
    return result;
  }

  Outputs outputs(Function f) const override {
    if (f == Function::kRnea) return {tau_.data};
    return {inertia_.data};
  }

  void run_crba(const VectorXd& q) {
    const int n = body().nv;
    const VectorXd position = zero_emulated(q);
    if (chain_) {
      q_.data = position;
      check(chain_->crba.JntToMass(q_, inertia_), chain_->crba);
      return;
    }
    const KDL::Tree built = tree(q);
    for (int j = 0; j < n; ++j)
      inertia_.data.col(j) = inverse_dynamics(built, KDL::Vector::Zero(), position,
                                              VectorXd::Zero(n), VectorXd::Unit(n, j));
  }

  template <class Solver>
  static void check(int status, const Solver& solver) {
    if (status != 0)
      throw std::runtime_error("KDL: " + std::string(solver.strError(solver.getError())));
  }

  static VectorXd inverse_dynamics(const KDL::Tree& tree, const KDL::Vector& gravity,
                                   const VectorXd& q, const VectorXd& v, const VectorXd& a) {
    KDL::TreeIdSolver_RNE solver(tree, gravity);
    return solve(solver, q, v, a);
  }

  /// No joint is emulated, so one tree serves all configurations.
  bool constant() const {
    return std::all_of(joints().begin(), joints().end(),
                       [](const Joint& joint) { return nv(joint.kind) <= 1; });
  }
  bool branchless() const {
    for (size_t k = 1; k < joints().size(); ++k)
      if (joints()[k].parent != joints()[k - 1].child) return false;
    return welded() && joints().front().parent == body().root;
  }

  static VectorXd solve(KDL::TreeIdSolver_RNE& solver, const VectorXd& q, const VectorXd& v,
                        const VectorXd& a) {
    KDL::JntArray tau(static_cast<unsigned>(v.size()));
    check(solver.CartToJnt(kdl(q), kdl(v), kdl(a), {}, tau), solver);
    return tau.data;
  }

  /// The coordinates of KDL's joints, as many as v.
  VectorXd zero_emulated(const VectorXd& q) const {
    VectorXd result = VectorXd::Zero(body().nv);
    for (const Joint& joint : joints())
      if (nv(joint.kind) == 1) result[joint.v] = q[joint.q];
    return result;
  }

  KDL::Tree tree(const VectorXd& q) const {
    KDL::Tree result("world");
    if (welded())
      result.addSegment(KDL::Segment(link_name(body().root), KDL::Joint(KDL::Joint::Fixed)),
                        "world");
    for (const Joint& joint : joints())
      add_joint(joint, q.segment(joint.q, nq(joint.kind)), result);
    return result;
  }

  void add_joint(const Joint& joint, const VectorXd& q, KDL::Tree& tree) const {
    const KDL::Frame T = kdl(joint);
    const KDL::Vector axis = T.M * kdl(vector(joint.axis));
    switch (joint.kind) {
      case Kind::kFixed: return add({KDL::Joint(KDL::Joint::Fixed)}, T, joint, tree);
      case Kind::kRevolute:
        return add({KDL::Joint(T.p, axis, KDL::Joint::RotAxis)}, T, joint, tree);
      case Kind::kPrismatic:
        return add({KDL::Joint(T.p, axis, KDL::Joint::TransAxis)}, T, joint, tree);
      case Kind::kPlanar: return add_planar(joint, q, tree);
      case Kind::kFloating: return add_floating(joint, q, tree);
    }
  }

  void add_planar(const Joint& joint, const VectorXd& q, KDL::Tree& tree) const {
    const Eigen::Matrix3d F = matrix(joint.plane);
    const KDL::Vector x = kdl(Vector3d(F.col(0))), y = kdl(Vector3d(F.col(1))),
                      z = kdl(Vector3d(F.col(2)));
    const KDL::Vector zero = KDL::Vector::Zero();
    const KDL::Frame T = kdl(joint) * KDL::Frame(KDL::Rotation::Rot(z, q[2]), x * q[0] + y * q[1]);
    add({KDL::Joint(T.p, T.M * x, KDL::Joint::TransAxis),
         KDL::Joint(zero, y, KDL::Joint::TransAxis), KDL::Joint(zero, z, KDL::Joint::RotAxis)},
        T, joint, tree);
  }

  void add_floating(const Joint& joint, const VectorXd& q, KDL::Tree& tree) const {
    const KDL::Frame T = kdl(joint) * KDL::Frame(KDL::Rotation::Quaternion(q[3], q[4], q[5], q[6]),
                                                 kdl(Vector3d(q.head<3>())));
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
          last ? link_name(joint.child)
               : "joint" + std::to_string(joint.child) + "." + std::to_string(i);
      tree.addSegment(
          KDL::Segment(name, chain[i], i == 0 ? T : KDL::Frame::Identity(),
                       last ? kdl(links()[joint.child]) : KDL::RigidBodyInertia::Zero()),
          parent);
      parent = name;
    }
  }

  static std::string link_name(int i) { return "link" + std::to_string(i); }

  KDL::Vector gravity_;
  KDL::JntArray q_, v_, a_, tau_;
  KDL::JntSpaceInertiaMatrix inertia_;
  KDL::Tree tree_;  ///< the solver refers to it
  std::unique_ptr<KDL::TreeIdSolver_RNE> tree_solver_;
  std::unique_ptr<Chain> chain_;  ///< where the body is one
};

}  // namespace

std::unique_ptr<Peer> make_kdl(const Body& body) { return std::make_unique<KdlPeer>(body); }

}  // namespace peers

// RBDL: a floating joint is three translations and a spherical joint.
#include <rbdl/rbdl.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "peer.hpp"

namespace peers {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
namespace rm = RigidBodyDynamics::Math;
namespace rd = RigidBodyDynamics;

class Rbdl : public Peer {
 public:
  explicit Rbdl(const Body& given) : Peer(given) {
    model_.gravity = vector(body().gravity);
    id_.resize(links().size());
    id_[body().root] = 0;
    for (const Joint& joint : joints()) {
      const Link& link = links()[joint.child];
      const unsigned parent = joint.parent < 0 ? 0 : id_[joint.parent];
      const rm::SpatialTransform X(matrix(joint.R).transpose(), vector(joint.p));
      const rd::Body mass(link.mass, rm::Vector3d(vector(link.c)), rm::Matrix3d(inertia(link)));
      id_[joint.child] = model_.AddBody(parent, X, joint_of(joint), mass);
    }
    tau_ = a_ = VectorXd::Zero(model_.qdot_size);
    M_ = MatrixXd::Zero(model_.qdot_size, model_.qdot_size);
  }

  bool has(Function f) const override {
    return f == Function::kRnea || f == Function::kCrba || f == Function::kAba;
  }

  void run(Function f, const State& x) override {
    if (f == Function::kRnea) {
      rd::InverseDynamics(model_, x.q, x.v, x.a, tau_);
    } else if (f == Function::kAba) {
      rd::ForwardDynamics(model_, x.q, x.v, x.tau, a_);
    } else {
      M_.setZero();
      rd::CompositeRigidBodyAlgorithm(model_, x.q, M_);
    }
  }

 private:
  static rd::Joint joint_of(const Joint& joint) {
    switch (joint.kind) {
      case Kind::kFixed: return rd::Joint(rd::JointTypeFixed);
      case Kind::kFloating: return rd::Joint(rd::JointTypeFloatingBase);
      case Kind::kPrismatic:
        return rd::Joint(rd::JointTypePrismatic, rm::Vector3d(vector(joint.axis)));
      default: break;
    }
    const Eigen::Vector3d axis = vector(joint.axis);
    if (axis == Eigen::Vector3d::UnitX()) return rd::Joint(rd::JointTypeRevoluteX);
    if (axis == Eigen::Vector3d::UnitY()) return rd::Joint(rd::JointTypeRevoluteY);
    if (axis == Eigen::Vector3d::UnitZ()) return rd::Joint(rd::JointTypeRevoluteZ);
    return rd::Joint(rd::JointTypeRevolute, rm::Vector3d(axis));
  }

  Rates rates(const Joint& joint, const VectorXd& q, const VectorXd& v) const override {
    return parent_axes(joint, q, v);
  }

  /// Its quaternions' real parts stand at the end of q; only the first joint can float.
  State converted(const State& x) const override {
    State y = x;
    if (joints().empty() || joints()[0].kind != Kind::kFloating) return y;
    for (int i = 6; i + 1 < x.q.size(); ++i) y.q[i] = x.q[i + 1];
    y.q[x.q.size() - 1] = x.q[6];
    return y;
  }

  Outputs outputs(Function f) const override {
    if (f == Function::kCrba) return {M_};
    return {f == Function::kRnea ? tau_ : a_};
  }

  rd::Model model_;
  std::vector<unsigned> id_;  ///< per link
  VectorXd tau_, a_;
  MatrixXd M_;
};

/// No joint is planar, and only the root floats.
bool supported(const Body& body) {
  return std::none_of(body.joint, body.joint + body.joints, [&](const Joint& joint) {
    return joint.kind == Kind::kPlanar || (joint.kind == Kind::kFloating && &joint != body.joint);
  });
}

}  // namespace

std::unique_ptr<Peer> make_rbdl(const Body& body) {
  return supported(body) ? std::make_unique<Rbdl>(body) : nullptr;
}

}  // namespace peers

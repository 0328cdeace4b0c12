// DART: a Skeleton with one body node a link.
//
// Floating joints are DART's, kept at their zero with the pose in the constant part: their rates
// are then those of the body's axes at every pose, and no rotation vector near pi is needed.
#include <Eigen/Geometry>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/PlanarJoint.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/math/Geometry.hpp>
#include <iostream>

#include "peer.hpp"

namespace peers {
namespace {

namespace dd = dart::dynamics;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Eigen::Isometry3d isometry(const Joint& joint) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = matrix(joint.R);
  T.translation() = vector(joint.p);
  return T;
}

/// Nothing written to the stream while it lives.
class Silence {
 public:
  explicit Silence(std::ostream& stream) : stream_(stream), buffer_(stream.rdbuf(nullptr)) {}
  ~Silence() {
    stream_.rdbuf(buffer_);
    stream_.clear();
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  std::ostream& stream_;
  std::streambuf* buffer_;
};

class DartPeer : public Peer {
 public:
  explicit DartPeer(const Body& given) : Peer(given), skeleton_(dd::Skeleton::create("body")) {
    const Silence about_bodies_without_mass(std::cerr), about_renamed_coordinates(std::cout);
    skeleton_->setGravity(vector(body().gravity));
    node_.resize(links().size());
    index_.resize(static_cast<size_t>(body().nv));
    if (welded()) add_body(nullptr, Joint{}, body().root);
    for (const Joint& joint : joints()) {
      dd::BodyNode* parent = joint.parent < 0 ? nullptr : node_[joint.parent];
      joint_.push_back(add_body(parent, joint, joint.child));
      for (int i = 0; i < nv(joint.kind); ++i)
        index_[joint.v + i] = static_cast<int>(joint_.back()->getIndexInSkeleton(i));
    }
  }

  bool has(Function f) const override {
    return f == Function::kRnea || f == Function::kCrba || f == Function::kAba;
  }

  void run(Function f, const State& x) override {
    place_floating(x.q);
    skeleton_->setPositions(x.q.tail(body().nv));
    if (f == Function::kCrba) {
      M_ = &skeleton_->getMassMatrix();
      return;
    }
    skeleton_->setVelocities(x.v);
    if (f == Function::kRnea) {
      skeleton_->setAccelerations(x.a);
      skeleton_->computeInverseDynamics();
    } else {
      skeleton_->setForces(x.tau);
      skeleton_->computeForwardDynamics();
    }
  }

 private:
  Rates rates(const Joint& joint, const VectorXd& q, const VectorXd& v) const override {
    if (joint.kind == Kind::kPlanar) return parent_axes(joint, q, v);
    Rates result{MatrixXd::Zero(6, 6), VectorXd::Zero(6)};  // angular before linear
    result.J.topRightCorner<3, 3>().setIdentity();
    result.J.bottomLeftCorner<3, 3>().setIdentity();
    return result;
  }

  /// q: ours, for the poses of floating joints, then DART's.
  State converted(const State& x) const override {
    VectorXd positions = VectorXd::Zero(body().nv);
    for (const Joint& joint : joints())
      if (joint.kind != Kind::kFloating)
        positions.segment(joint.v, nv(joint.kind)) = x.q.segment(joint.q, nq(joint.kind));
    State result{VectorXd(body().nq + body().nv), to_dart(x.v), to_dart(x.a), to_dart(x.tau)};
    result.q << x.q, to_dart(positions);
    return result;
  }

  Outputs outputs(Function f) const override {
    const int n = body().nv;
    // One by one: a vector made inside DART could not be freed here in a build with sanitizers,
    // where Eigen allocates in another way.
    if (f == Function::kCrba)
      return {MatrixXd::NullaryExpr(
          n, n, [&](Eigen::Index i, Eigen::Index j) { return (*M_)(index_[i], index_[j]); })};
    return {MatrixXd::NullaryExpr(n, 1, [&](Eigen::Index i, Eigen::Index) {
      return f == Function::kRnea ? skeleton_->getForce(index_[i])
                                  : skeleton_->getAcceleration(index_[i]);
    })};
  }

  VectorXd to_dart(const VectorXd& x) const {
    VectorXd result(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) result[index_[i]] = x[i];
    return result;
  }

  void place_floating(const VectorXd& q) {
    for (size_t k = 0; k < joints().size(); ++k) {
      const Joint& joint = joints()[k];
      if (joint.kind != Kind::kFloating) continue;
      const double* at = &q[joint.q];
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.linear() = Eigen::Quaterniond(at[6], at[3], at[4], at[5]).toRotationMatrix();
      T.translation() = vector(at);
      joint_[k]->setTransformFromParentBodyNode(isometry(joint) * T);
    }
  }

  dd::Joint* add_body(dd::BodyNode* parent, const Joint& joint, int link) {
    dd::Joint* made = nullptr;
    switch (joint.kind) {
      case Kind::kFixed: made = add<dd::WeldJoint>(parent, link); break;
      case Kind::kFloating: made = add<dd::FreeJoint>(parent, link); break;
      case Kind::kRevolute: {
        auto* revolute = add<dd::RevoluteJoint>(parent, link);
        revolute->setAxis(vector(joint.axis));
        made = revolute;
        break;
      }
      case Kind::kPrismatic: {
        auto* prismatic = add<dd::PrismaticJoint>(parent, link);
        prismatic->setAxis(vector(joint.axis));
        made = prismatic;
        break;
      }
      case Kind::kPlanar: {
        auto* planar = add<dd::PlanarJoint>(parent, link);
        const Eigen::Matrix3d F = matrix(joint.plane);
        planar->setArbitraryPlane(F.col(0), F.col(1));
        made = planar;
        break;
      }
    }
    made->setTransformFromParentBodyNode(isometry(joint));
    const Link& mass = links()[static_cast<size_t>(link)];
    node_[link]->setInertia({mass.mass, vector(mass.c), inertia(mass)});
    return made;
  }

  template <class JointNode>
  JointNode* add(dd::BodyNode* parent, int link) {
    typename JointNode::Properties joint_properties;
    joint_properties.mName = "joint" + std::to_string(link);
    dd::BodyNode::Properties body_properties;
    body_properties.mName = "link" + std::to_string(link);
    const auto [joint, node] =
        skeleton_->createJointAndBodyNodePair<JointNode>(parent, joint_properties, body_properties);
    node_[link] = node;
    return joint;
  }

  dd::SkeletonPtr skeleton_;
  std::vector<dd::BodyNode*> node_;  ///< per link
  std::vector<dd::Joint*> joint_;    ///< per joint
  std::vector<int> index_;           ///< of each degree of freedom in the skeleton
  const MatrixXd* M_ = nullptr;      ///< the skeleton's
};

}  // namespace

std::unique_ptr<Peer> make_dart(const Body& body) { return std::make_unique<DartPeer>(body); }

}  // namespace peers

// DART: a Skeleton with one body node a link.
//
// Floating joints are DART's, kept at their zero with the pose in the constant part: their rates
// are then those of the body's axes at every pose, and no rotation vector near pi is needed.
#include <fmt/format.h>

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
#include <stdexcept>

#include "differential/peer.h"

namespace arboc::test {
namespace {

namespace dd = dart::dynamics;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

Vector3d vector(const Vector3<double>& a) { return {a.x, a.y, a.z}; }

Eigen::Isometry3d isometry(const Pose& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = dart::math::eulerZYXToMatrix(Vector3d(pose.rpy.z, pose.rpy.y, pose.rpy.x));
  T.translation() = vector(pose.xyz);
  return T;
}

dd::Inertia inertia(const Inertial& inertial) {
  const Symmetric3<double>& S = inertial.inertia;
  Eigen::Matrix3d I;
  I << S.xx, S.xy, S.xz, S.xy, S.yy, S.yz, S.xz, S.yz, S.zz;
  const Eigen::Matrix3d R = isometry(inertial.origin).linear();
  return {inertial.mass, vector(inertial.origin.xyz), R * I * R.transpose()};
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
  explicit DartPeer(const Model& given) : Peer(given), skeleton_(dd::Skeleton::create("model")) {
    const Silence about_bodies_without_mass(std::cerr), about_renamed_coordinates(std::cout);
    skeleton_->setGravity(vector(model().gravity));
    body_.resize(model().links.size());
    joint_.resize(model().joints.size());
    index_.resize(where().nv);
    const bool welded = model().joints.empty() || model().joints[0].parent >= 0;
    if (welded) add_body(nullptr, Joint{}, 0);
    for (size_t k = 0; k < model().joints.size(); ++k) {
      const Joint& joint = model().joints[k];
      joint_[k] = add_body(joint.parent < 0 ? nullptr : body_[joint.parent], joint, joint.child);
      for (int i = 0; i < nv(joint.type); ++i)
        index_[where().joint[k].v + i] = static_cast<int>(joint_[k]->getIndexInSkeleton(i));
    }
  }

 private:
  Rates rates(const Joint& joint, const VectorXd& q, const VectorXd& v) const override {
    if (joint.type == JointType::kPlanar) return parent_axes(joint, q, v);
    Rates result{MatrixXd::Zero(6, 6), VectorXd::Zero(6)};  // angular before linear
    result.J.topRightCorner<3, 3>().setIdentity();
    result.J.bottomLeftCorner<3, 3>().setIdentity();
    return result;
  }

  VectorXd peer_rnea(const VectorXd& q, const VectorXd& v, const VectorXd& a) override {
    set_configuration(q);
    skeleton_->setVelocities(to_dart(v));
    skeleton_->setAccelerations(to_dart(a));
    skeleton_->computeInverseDynamics();
    // One by one: a vector made inside DART could not be freed here in a build with sanitizers,
    // where Eigen allocates in another way.
    return VectorXd::NullaryExpr(where().nv,
                                 [&](Eigen::Index i) { return skeleton_->getForce(index_[i]); });
  }

  MatrixXd peer_crba(const VectorXd& q) override {
    set_configuration(q);
    const MatrixXd M = skeleton_->getMassMatrix();
    return MatrixXd::NullaryExpr(where().nv, where().nv, [&](Eigen::Index i, Eigen::Index j) {
      return M(index_[i], index_[j]);
    });
  }

  VectorXd to_dart(const VectorXd& x) const {
    VectorXd result(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) result[index_[i]] = x[i];
    return result;
  }

  void set_configuration(const VectorXd& q) {
    VectorXd positions = VectorXd::Zero(where().nv);
    for (size_t k = 0; k < model().joints.size(); ++k) {
      const Joint& joint = model().joints[k];
      const Coordinates::Entry& at = where().joint[k];
      if (joint.type == JointType::kFloating) {
        Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
        T.linear() = Eigen::Quaterniond(q[at.q + 6], q[at.q + 3], q[at.q + 4], q[at.q + 5])
                         .toRotationMatrix();
        T.translation() = q.segment<3>(at.q);
        joint_[k]->setTransformFromParentBodyNode(isometry(joint.origin) * T);
      } else if (joint.type != JointType::kFixed) {
        positions.segment(at.v, nv(joint.type)) = q.segment(at.q, nq(joint.type));
      }
    }
    skeleton_->setPositions(to_dart(positions));
  }

  dd::Joint* add_body(dd::BodyNode* parent, const Joint& joint, int link) {
    dd::Joint* made = nullptr;
    switch (joint.type) {
      case JointType::kFixed: made = add<dd::WeldJoint>(parent, link); break;
      case JointType::kFloating: made = add<dd::FreeJoint>(parent, link); break;
      case JointType::kRevolute:
      case JointType::kContinuous: {
        auto* revolute = add<dd::RevoluteJoint>(parent, link);
        revolute->setAxis(vector(joint.axis));
        made = revolute;
        break;
      }
      case JointType::kPrismatic: {
        auto* prismatic = add<dd::PrismaticJoint>(parent, link);
        prismatic->setAxis(vector(joint.axis));
        made = prismatic;
        break;
      }
      case JointType::kPlanar: {
        auto* planar = add<dd::PlanarJoint>(parent, link);
        const Matrix3<double> F = axis_frame(joint.axis);
        planar->setArbitraryPlane(vector(column(F, 0)), vector(column(F, 1)));
        made = planar;
        break;
      }
      default: throw std::logic_error("no URDF joint");
    }
    made->setTransformFromParentBodyNode(isometry(joint.origin));
    body_[link]->setInertia(inertia(model().links[link].inertial.value_or(Inertial{})));
    return made;
  }

  template <class JointNode>
  JointNode* add(dd::BodyNode* parent, int link) {
    typename JointNode::Properties joint_properties;
    joint_properties.mName = fmt::format("joint{}", link);
    dd::BodyNode::Properties body_properties;
    body_properties.mName = fmt::format("link{}", link);
    const auto [joint, body] =
        skeleton_->createJointAndBodyNodePair<JointNode>(parent, joint_properties, body_properties);
    body_[link] = body;
    return joint;
  }

  dd::SkeletonPtr skeleton_;
  std::vector<dd::BodyNode*> body_;  ///< per link
  std::vector<dd::Joint*> joint_;    ///< per joint
  std::vector<int> index_;           ///< of each degree of freedom in the skeleton
};

}  // namespace

std::unique_ptr<Peer> make_dart(const Model& model) { return std::make_unique<DartPeer>(model); }

}  // namespace arboc::test

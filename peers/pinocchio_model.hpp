// A Pinocchio model from a Body, of any scalar: as Pinocchio's own reader would build it, with
// joints about the axes x, y and z as such, and fixed joints merged.
//
// Pinocchio's rates are ours.  Its joints are numbered depth first, as ours are.
#pragma once
#include <pinocchio/fwd.hpp>
// After fwd.hpp.
#include <Eigen/Geometry>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/multibody/model.hpp>

#include "peer.hpp"

namespace peers {

inline pinocchio::SE3 placement(const Joint& joint) { return {matrix(joint.R), vector(joint.p)}; }

/// Adds X, Y or Z where the axis is that, else Unaligned.
template <class X, class Y, class Z, class Unaligned>
pinocchio::JointIndex add_joint(pinocchio::Model& model, pinocchio::JointIndex parent,
                                const Eigen::Vector3d& axis, const pinocchio::SE3& M,
                                const std::string& name) {
  if (axis == Eigen::Vector3d::UnitX()) return model.addJoint(parent, X(), M, name);
  if (axis == Eigen::Vector3d::UnitY()) return model.addJoint(parent, Y(), M, name);
  if (axis == Eigen::Vector3d::UnitZ()) return model.addJoint(parent, Z(), M, name);
  return model.addJoint(parent, Unaligned(axis), M, name);
}

inline pinocchio::JointIndex add_joint(pinocchio::Model& model, pinocchio::JointIndex parent,
                                       const Joint& joint, const pinocchio::SE3& M) {
  namespace pin = pinocchio;
  const std::string name = "joint" + std::to_string(joint.child);
  switch (joint.kind) {
    case Kind::kRevolute:
      return add_joint<pin::JointModelRX, pin::JointModelRY, pin::JointModelRZ,
                       pin::JointModelRevoluteUnaligned>(model, parent, vector(joint.axis), M,
                                                         name);
    case Kind::kPrismatic:
      return add_joint<pin::JointModelPX, pin::JointModelPY, pin::JointModelPZ,
                       pin::JointModelPrismaticUnaligned>(model, parent, vector(joint.axis), M,
                                                          name);
    default: return model.addJoint(parent, pin::JointModelFreeFlyer(), M, name);
  }
}

inline pinocchio::Model pinocchio_model(const Body& body) {
  namespace pin = pinocchio;
  struct Place {
    pin::JointIndex joint = 0;
    pin::SE3 M = pin::SE3::Identity();
  };
  pin::Model model;
  model.gravity.linear(vector(body.gravity));
  std::vector<Place> place(static_cast<size_t>(body.links));
  const auto add_mass = [&](int l) {
    const Link& link = body.link[l];
    const Place& at = place[static_cast<size_t>(l)];
    if (link.massive)
      model.appendBodyToJoint(at.joint, {link.mass, vector(link.c), inertia(link)}, at.M);
  };
  if (body.joints == 0 || body.joint[0].parent >= 0) add_mass(body.root);
  for (const Joint* joint = body.joint; joint != body.joint + body.joints; ++joint) {
    Place& at = place[static_cast<size_t>(joint->child)];
    if (joint->parent >= 0) at = place[static_cast<size_t>(joint->parent)];
    at.M = at.M * placement(*joint);
    if (joint->kind != Kind::kFixed) at = {add_joint(model, at.joint, *joint, at.M), {}};
    if (joint->kind != Kind::kFixed) at.M.setIdentity();
    add_mass(joint->child);
  }
  return model;
}

/// Planar joints have axes of their own there.
inline bool pinocchio_has(const Body& body) {
  for (int k = 0; k < body.joints; ++k)
    if (body.joint[k].kind == Kind::kPlanar) return false;
  return true;
}

}  // namespace peers

#include "tree/merge_fixed.h"

namespace arboc {
namespace {

Motion motion(JointType type) {
  switch (type) {
    case JointType::kRevolute:
    case JointType::kContinuous:
    case JointType::kUnbounded: return Motion::kRevolute;
    case JointType::kPrismatic: return Motion::kPrismatic;
    case JointType::kPlanar: return Motion::kPlanar;
    case JointType::kFloating: return Motion::kFloating;
    case JointType::kSpherical: return Motion::kSpherical;
    default: break;  // fixed; others are not there behind configure()
  }
  return Motion::kWorld;
}

}  // namespace

Body moving_body(const Model& model, size_t k, const Coordinates& coordinates) {
  const Joint& joint = model.joints[k];
  const Coordinates::Entry& entry = coordinates.joint[k];
  Body body;
  body.link = model.links[static_cast<size_t>(joint.child)].name;
  body.joint = joint.name;
  body.motion = motion(joint.type);
  body.q = entry.q;
  body.v = entry.v;
  body.multiplier = entry.multiplier;
  body.offset = entry.offset;
  body.circle = joint.type == JointType::kUnbounded;
  return body;
}

NumbersOf<double> numbers(const Model& model, const JointForces& forces) {
  NumbersOf<double> result;
  result.gravity = model.gravity;
  result.friction_velocity = forces.friction_velocity;
  for (const Joint& joint : model.joints) {
    result.origin.push_back(joint.origin.xyz);
    if (!forces.any()) continue;
    result.forces.push_back({forces.damping ? joint.damping : 0,
                             forces.friction ? joint.friction : 0,
                             forces.stiffness && nq(joint) == 1 ? joint.stiffness : 0,
                             joint.neutral, forces.rotor ? joint.rotor_inertia : 0});
  }
  for (const Link& link : model.links)
    result.moments.push_back(link.inertial ? mass_moments(*link.inertial) : MassMoments{});
  return result;
}

}  // namespace arboc

#include "tree/merge_fixed.h"

#include "tree/mass_moments.h"
#include "tree/tallied.h"

namespace arboc {
namespace {

Motion motion(JointType type) {
  switch (type) {
    case JointType::kFixed: return Motion::kWorld;
    case JointType::kRevolute:
    case JointType::kContinuous: return Motion::kRevolute;
    case JointType::kPrismatic: return Motion::kPrismatic;
    case JointType::kPlanar: return Motion::kPlanar;
    case JointType::kFloating: return Motion::kFloating;
  }
  return Motion::kWorld;
}

DraftBody moving_body(const Model& model, const Joint& joint, const Coordinates::Entry& entry) {
  DraftBody result;
  Body& body = result.body;
  body.link = model.links[static_cast<size_t>(joint.child)].name;
  body.joint = joint.name;
  body.motion = motion(joint.type);
  body.q = entry.q;
  body.v = entry.v;
  body.multiplier = entry.multiplier;
  body.offset = entry.offset;
  if (joint.type != JointType::kFloating) result.axis = joint.axis;
  return result;
}

/// Places the child's frame: on a new body if the joint moves, else on the parent's body.
void place_child(const Model& model, size_t k, const Coordinates& coordinates, Draft& draft) {
  const Joint& joint = model.joints[k];
  const Frame world{"", 0, Matrix3<double>::identity(), {}, false};
  const Frame& parent = joint.parent < 0 ? world : draft.frame[static_cast<size_t>(joint.parent)];
  const Matrix3<double> R = rotate(parent.R, rotation(joint.origin));
  const Vector3<double> p = place(parent.R, joint.origin.xyz, parent.p);
  Frame& child = draft.frame[static_cast<size_t>(joint.child)];
  if (joint.type == JointType::kFixed) {
    child.body = parent.body;
    child.R = R;
    child.p = p;
    return;
  }
  DraftBody body = moving_body(model, joint, coordinates.joint[k]);
  body.R = R;
  body.body.c = p;
  body.body.parent = parent.body;
  child.body = static_cast<int>(draft.body.size());
  child.moving = true;
  draft.body.push_back(std::move(body));
}

}  // namespace

Draft merge_fixed(const Model& model) {
  Draft draft;
  draft.name = model.name;
  draft.gravity = model.gravity;
  draft.body.emplace_back();
  draft.body[0].body.link = "world";
  for (const Link& link : model.links)
    draft.frame.push_back({link.name, 0, Matrix3<double>::identity(), {}, false});

  const Coordinates coords = coordinates(model);
  draft.nq = coords.nq;
  draft.nv = coords.nv;
  for (size_t k = 0; k < model.joints.size(); ++k) place_child(model, k, coords, draft);

  for (size_t k = 0; k < model.links.size(); ++k) {
    const Frame& frame = draft.frame[k];
    if (!model.links[k].inertial || frame.body == 0) continue;
    MassMoments& total = draft.body[static_cast<size_t>(frame.body)].body.inertia;
    total = total + move(mass_moments(*model.links[k].inertial), frame.R, frame.p);
  }
  return draft;
}

}  // namespace arboc

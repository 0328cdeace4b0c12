// Model -> Draft: bodies are the links that move; what is welded to one joins it.
#pragma once
#include "tree/draft.h"
#include "tree/numbers.h"

namespace arboc {

/// What the joint `k` of a model adds to the tree, without numbers.
Body moving_body(const Model& model, size_t k, const Coordinates& coordinates);

/// Places the child's frame of joint k: on a new body if the joint moves, else on the parent's.
template <class S>
void place_child(const Model& model, size_t k, const Coordinates& coordinates,
                 const NumbersOf<S>& numbers, DraftOf<S>& draft) {
  const Joint& joint = model.joints[k];
  const FrameOf<S> world;
  const FrameOf<S>& parent =
      joint.parent < 0 ? world : draft.frame[static_cast<size_t>(joint.parent)];
  const Matrix3<double> R = rotate(parent.R, rotation(joint.origin));
  const Vector3<S> p = place(parent.R, numbers.origin[k], parent.p);
  FrameOf<S>& child = draft.frame[static_cast<size_t>(joint.child)];
  if (joint.type == JointType::kFixed) {
    child.body = parent.body;
    child.R = R;
    child.p = p;
    return;
  }
  DraftBodyOf<S> body;
  static_cast<Body&>(body.body) = moving_body(model, k, coordinates);
  if (has_axis(joint.type)) body.axis = joint.axis;
  body.R = R;
  body.body.c = p;
  body.body.parent = parent.body;
  if (!numbers.forces.empty()) body.body.forces = numbers.forces[k];
  child.body = static_cast<int>(draft.body.size());
  child.moving = true;
  draft.body.push_back(std::move(body));
}

/// After: one body a moving joint, in the order of the joints, with the inertia of everything
/// welded to it; links welded to the world keep only a frame on body 0.  Linear.
template <class S>
DraftOf<S> merge_fixed(const Model& model, const NumbersOf<S>& numbers) {
  DraftOf<S> draft;
  draft.name = model.name;
  draft.gravity = numbers.gravity;
  draft.joint_forces = !numbers.forces.empty();
  draft.friction_velocity = numbers.friction_velocity;
  draft.body.emplace_back();
  draft.body[0].body.link = "world";
  draft.frame.resize(model.links.size());
  for (size_t k = 0; k < model.links.size(); ++k) draft.frame[k].name = model.links[k].name;

  const Coordinates coords = coordinates(model);
  draft.nq = coords.nq;
  draft.nv = coords.nv;
  for (size_t k = 0; k < model.joints.size(); ++k) place_child(model, k, coords, numbers, draft);

  for (size_t k = 0; k < model.links.size(); ++k) {
    const FrameOf<S>& frame = draft.frame[k];
    if (!model.links[k].inertial || frame.body == 0) continue;
    MassMomentsOf<S>& total = draft.body[static_cast<size_t>(frame.body)].body.inertia;
    total = total + move(numbers.moments[k], frame.R, frame.p);
  }
  return draft;
}

}  // namespace arboc

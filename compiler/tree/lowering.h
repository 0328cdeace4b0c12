// lower() for any kind of numbers: the steps in their order.
#pragma once
#include "base/exact_trig.h"
#include "tree/axis_frames.h"
#include "tree/coupling.h"
#include "tree/denavit.h"
#include "tree/factor.h"
#include "tree/lower.h"
#include "tree/merge_fixed.h"
#include "tree/regroup.h"

namespace arboc {

/// Factors the constant rotations; what a mimic joint adds to its angle joins theta.
template <class S>
DynamicTreeOf<S> assemble(DraftOf<S> draft) {
  DynamicTreeOf<S> tree;
  tree.name = std::move(draft.name);
  tree.nq = draft.nq;
  tree.nv = draft.nv;
  tree.gravity = draft.gravity;
  tree.joint_forces = draft.joint_forces;
  tree.friction_velocity = draft.friction_velocity;
  tree.frame = std::move(draft.frame);
  for (DraftBodyOf<S>& b : draft.body) {
    BodyOf<S>& body = b.body;
    const Factors factors = factor(b.R);
    Turn theta = factors.theta;
    if (body.motion == Motion::kRevolute && body.offset != 0) {
      const SinCos offset = exact_sincos(body.offset);
      theta = clean_unit(compose(theta, Turn{offset.cos, offset.sin}));
      body.forces.neutral = body.forces.neutral - S(body.offset);
      body.offset = 0;
    }
    body.gamma = cast<S>(factors.gamma);
    body.alpha = cast<S>(factors.alpha);
    body.theta = cast<S>(theta);
    tree.body.push_back(std::move(body));
  }
  if (tree.nv <= DynamicTree::kLargestMatrix)
    tree.coupled = coupling({tree.body.begin(), tree.body.end()}, tree.nv);
  return tree;
}

/// Frames are chosen by looking at `nominal` and applied to both.
template <class S>
void choose_frames(const LoweringOptions& options, Draft& nominal, DraftOf<S>* draft) {
  const auto apply = [&](const std::vector<Reframe>& frames) {
    reframe(nominal, frames);
    if (draft) reframe(*draft, frames);
  };
  apply(axis_frames(nominal));
  for (DraftBody& b : nominal.body) b.axis = {0, 0, 1};
  if (options.frames == FrameChoice::kDenavit) apply(denavit_frames(nominal));
}

template <class S>
DynamicTreeOf<S> lower(const Model& model, const LoweringOptions& options,
                       const NumbersOf<S>& numbers) {
  Draft nominal = merge_fixed(model, arboc::numbers(model));
  DraftOf<S> draft = merge_fixed(model, numbers);
  choose_frames(options, nominal, &draft);
  if (options.regroup) regroup(draft);
  return assemble(std::move(draft));
}

}  // namespace arboc

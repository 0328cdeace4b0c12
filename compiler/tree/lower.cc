#include "tree/lower.h"

#include "base/exact_trig.h"
#include "tree/axis_frames.h"
#include "tree/coupling.h"
#include "tree/denavit.h"
#include "tree/factor.h"
#include "tree/merge_fixed.h"
#include "tree/regroup.h"
#include "tree/tallied.h"

namespace arboc {
namespace {

/// Factors the constant rotations; what a mimic joint adds to its angle joins theta.
DynamicTree assemble(Draft draft) {
  DynamicTree tree;
  tree.name = std::move(draft.name);
  tree.nq = draft.nq;
  tree.nv = draft.nv;
  tree.gravity = draft.gravity;
  tree.frame = std::move(draft.frame);
  for (DraftBody& b : draft.body) {
    Body& body = b.body;
    const Factors factors = factor(b.R);
    body.gamma = factors.gamma;
    body.alpha = factors.alpha;
    body.theta = factors.theta;
    if (body.motion == Motion::kRevolute && body.offset != 0) {
      const SinCos offset = exact_sincos(body.offset);
      body.theta = clean_unit(compose(body.theta, Turn{offset.cos, offset.sin}));
      body.offset = 0;
    }
    tree.body.push_back(std::move(body));
  }
  return tree;
}

}  // namespace

DynamicTree lower(const Model& model, const LoweringOptions& options) {
  Draft draft = merge_fixed(model);
  turn_axes_to_z(draft);
  if (options.frames == FrameChoice::kDenavit) choose_denavit_frames(draft);
  if (options.regroup) regroup(draft);
  DynamicTree tree = assemble(std::move(draft));
  if (tree.nv <= DynamicTree::kLargestMatrix) tree.coupled = coupling(tree);
  return tree;
}

}  // namespace arboc

#include "tree/regroup.h"

#include "tree/mass_moments.h"

namespace arboc {
namespace {

/// Takes from `inertia` what the joint cannot tell from a part of the parent.
MassMoments take_common(Motion motion, MassMoments& inertia) {
  MassMoments common;
  switch (motion) {
    case Motion::kRevolute:
      common.m = inertia.m;
      common.h.z = inertia.h.z;
      common.Sigma.zz = inertia.Sigma.zz;
      inertia.m = inertia.h.z = inertia.Sigma.zz = 0;
      break;
    case Motion::kPrismatic:
      common.Sigma = inertia.Sigma;
      inertia.Sigma = {};
      break;
    case Motion::kPlanar:
      common.Sigma.zz = inertia.Sigma.zz;
      inertia.Sigma.zz = 0;
      break;
    case Motion::kFloating:
    case Motion::kWorld: break;
  }
  return common;
}

}  // namespace

void regroup(Draft& draft) {
  for (size_t i = draft.body.size() - 1; i > 0; --i) {
    DraftBody& b = draft.body[i];
    const MassMoments common = take_common(b.body.motion, b.body.inertia);
    if (b.body.parent == 0) continue;
    MassMoments& parent = draft.body[static_cast<size_t>(b.body.parent)].body.inertia;
    // Without m and h the origin of the second moment does not matter: c drops out by itself.
    parent = parent + move(common, b.R, b.body.c);
  }
}

}  // namespace arboc

// Moves inertial parameters that act like the parent's to the parent (base parameters, [Khalil]).
//
// A mass distribution on a revolute axis moves equally with both bodies: m, h_z, Sigma_zz leave.
// Behind a prismatic joint nothing turns: all of Sigma leaves.  A planar joint turns and slides,
// so only Sigma_zz leaves.  A mass at the centre of a spherical joint stays there.  What reaches
// the world is dropped.
#pragma once
#include "tree/draft.h"

namespace arboc {

/// Takes from `inertia` what the joint cannot tell from a part of the parent.
template <class S>
MassMomentsOf<S> take_common(Motion motion, MassMomentsOf<S>& inertia) {
  MassMomentsOf<S> common;
  switch (motion) {
    case Motion::kRevolute:
      common.m = inertia.m;
      common.h.z = inertia.h.z;
      common.Sigma.zz = inertia.Sigma.zz;
      inertia.m = inertia.h.z = inertia.Sigma.zz = S(0);
      break;
    case Motion::kPrismatic:
      common.Sigma = inertia.Sigma;
      inertia.Sigma = {};
      break;
    case Motion::kPlanar:
      common.Sigma.zz = inertia.Sigma.zz;
      inertia.Sigma.zz = S(0);
      break;
    case Motion::kSpherical:
      common.m = inertia.m;
      inertia.m = S(0);
      break;
    case Motion::kFloating:
    case Motion::kWorld: break;
  }
  return common;
}

/// Before: axes on z.  After: those parameters are zero; tau, M and their derivatives are as
/// before, but the parameters are no longer those of a physical body (m = 0, Sigma indefinite).
template <class S>
void regroup(DraftOf<S>& draft) {
  for (size_t i = draft.body.size() - 1; i > 0; --i) {
    DraftBodyOf<S>& b = draft.body[i];
    const MassMomentsOf<S> common = take_common(b.body.motion, b.body.inertia);
    if (b.body.parent == 0) continue;
    MassMomentsOf<S>& parent = draft.body[static_cast<size_t>(b.body.parent)].body.inertia;
    // Without m and h the origin of the second moment does not matter: c drops out by itself.
    parent = parent + move(common, b.R, b.body.c);
  }
}

}  // namespace arboc

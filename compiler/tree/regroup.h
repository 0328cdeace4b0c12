// Moves inertial parameters that act like the parent's to the parent (base parameters, [Khalil]).
//
// A mass distribution on a revolute axis moves equally with both bodies: m, h_z, Sigma_zz leave.
// Behind a prismatic joint nothing turns: all of Sigma leaves.  A planar joint turns and slides,
// so only Sigma_zz leaves.  What reaches the world is dropped.
#pragma once
#include "tree/draft.h"

namespace arboc {

/// Before: axes on z.  After: those parameters are zero; tau, M and their derivatives are as
/// before, but the parameters are no longer those of a physical body (m = 0, Sigma indefinite).
void regroup(Draft& draft);

}  // namespace arboc

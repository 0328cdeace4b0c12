// Chooses modified Denavit-Hartenberg frames along the main child of every body.
//
// With the axis on z a joint leaves free where on the axis the origin sits and, if nothing
// measures along x and y, how the frame is turned about z.  Both are spent on the child with the
// largest subtree: x along the common normal, the origin at its foot, so that this child's
// placement is Rx(alpha) up to a signed permutation and an offset (a, -b sin alpha, b cos alpha).
#pragma once
#include "tree/draft.h"

namespace arboc {

/// Before: axes on z.  A revolute leaf is turned so that h_y = 0.  Children other than the main
/// one, and the children of the world and of a floating base, keep general placements.
std::vector<Reframe> denavit_frames(const Draft& draft);

}  // namespace arboc

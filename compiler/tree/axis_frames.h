// Turns every body's frame so that its joint's axis is z.
#pragma once
#include "tree/draft.h"

namespace arboc {

/// After: axis = (0, 0, 1) for every body.  Axes along +-x, +-y, +-z cost a signed permutation
/// only, and -z becomes +z, so no sign stays in a joint.  Planar joints keep the meaning of their
/// x and y, floating ones are left alone.
void turn_axes_to_z(Draft& draft);

}  // namespace arboc

// The frame of every body with its joint's axis on z.
#pragma once
#include "tree/draft.h"

namespace arboc {

/// Axes along +-x, +-y, +-z cost a signed permutation only, and -z becomes +z, so no sign stays in
/// a joint.  Planar joints keep the meaning of their x and y, floating and spherical ones are
/// left alone.
std::vector<Reframe> axis_frames(const Draft& draft);

}  // namespace arboc

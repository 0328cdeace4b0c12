// Model -> Draft: bodies are the links that move; what is welded to one joins it.
#pragma once
#include "model/model.h"
#include "tree/draft.h"

namespace arboc {

/// After: one body a moving joint, in the order of the joints, with the inertia of everything
/// welded to it; links welded to the world keep only a frame on body 0.  Linear.
Draft merge_fixed(const Model& model);

}  // namespace arboc

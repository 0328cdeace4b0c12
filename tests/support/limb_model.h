// Random models with isomorphic limbs planted on a random trunk.
#pragma once
#include "support/random_model.h"

namespace arboc::test {

struct LimbModelOptions {
  Base base = Base::kFloating;
  int limbs = 4;
};

/// Limbs of one random shape, with joints of every type and mimic joints, but with numbers of their
/// own; some numbers and directions are the same in all.  Configured.
Model limb_model(std::uint64_t seed, const LimbModelOptions& options);

}  // namespace arboc::test

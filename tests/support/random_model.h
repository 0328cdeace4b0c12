// Random models that use everything a Model can say.
//
// Trees with branches; any axes, many of them +-x, +-y, +-z; placements with right angles,
// multiples of 15 degrees and arbitrary ones; fixed joints, also above the first moving one;
// massless links; mimic followers in chains, with negative multipliers, leading from any branch to
// any other.  The joint-space inertia is positive definite unless massless leaves are asked for.
#pragma once
#include <cstdint>
#include <vector>

#include "model/model.h"

namespace arboc::test {

struct RandomModelOptions {
  int joints = 9;  ///< of the file, the root's floating joint not counted
  Base base = Base::kFixed;
  bool floating = true;  ///< floating joints between links
  bool planar = true;
  bool prismatic = true;
  bool mimic = true;
  bool massless = true;            ///< inner links without inertia
  bool massless_leaves = false;    ///< moving leaves too: the inertia is then singular
  bool exotic = false;             ///< unbounded, helical, spherical, universal, multi-axis joints
  std::vector<JointType> types{};  ///< of the joints, in place of random ones
};

/// A configured model, the same for the same seed and options.
Model random_model(std::uint64_t seed, const RandomModelOptions& options = {});

}  // namespace arboc::test

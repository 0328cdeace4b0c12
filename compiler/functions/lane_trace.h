// A function of one state with isomorphic limbs in the lanes of vectors: shared bodies are traced
// as scalars, of each group one limb on packs (docs/limbs.md).
#pragma once
#include <optional>

#include "functions/trace.h"
#include "tree/limbs.h"

namespace arboc {

/// The limbs that go in lanes.
std::vector<LimbGroup> limbs_in_lanes(const Setup& setup, const LoweringOptions& lowering);

/// The same inputs and outputs as the plain trace, whose patterns are given; nothing where the tree
/// has no such limbs, or where the function needs more than sums over them: derivatives on the
/// graph that no algorithm has, parameters, loads, and algorithms in which limbs meet one another.
std::optional<Graph> trace_in_lanes(const Request& request, const Setup& setup,
                                    const LoweringOptions& lowering,
                                    const std::vector<Pattern>& patterns);

}  // namespace arboc

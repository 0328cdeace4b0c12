// An order of nodes in which limbs can be computed one after the other (docs/limbs.md): runs of
// scalars, and runs of what is in the lanes of one group of limbs.
#pragma once
#include <cstdint>
#include <vector>

#include "graph/graph.h"

namespace arboc {

struct Phase {
  int limbs = 0;  ///< that the nodes stand for; 0: scalars
  std::vector<std::uint32_t> nodes;
};

/// Whether a pack takes entries of one input, with one sign: a limb can look its own up.
bool gathers_input(const Region& region, const Node& node);

/// The nodes but those that are `placed`, which are there from the start.  A phase has all that can
/// be computed when it begins, in the order of the region, and reads lanes of earlier phases only.
std::vector<Phase> limb_phases(const Region& region, const std::vector<char>& placed);

}  // namespace arboc

// What expressions will cost when sums of products are fused: to choose between ways to write them.
#pragma once
#include <vector>

#include "graph/graph.h"

namespace arboc {

/// Operations of all that `roots` need, as schedule() will count them after the passes, up to some
/// 2 % (opposite terms cancel late); sines and cosines not counted.  Cost: O(nodes).
int estimated_cost(const Region& region, const std::vector<Ref>& roots);

}  // namespace arboc

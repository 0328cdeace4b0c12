// Removes what no output needs.
#pragma once
#include "graph/graph.h"

namespace arboc {

/// Before: any verified graph.  After: every node but the inputs is used by an output, in the same
/// order.  Values: the same bits.  Cost: O(nodes).
/// Needed because tracing computes whole vectors of which an output may use one component.
Graph remove_dead(const Graph& graph);

}  // namespace arboc

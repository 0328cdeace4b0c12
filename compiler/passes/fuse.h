// Turns sums of products into chains of fused multiply-adds.
#pragma once
#include "graph/graph.h"

namespace arboc {

/// Before: a verified graph without n-ary sums.  After: there is no binary addition; each n-ary sum
/// lists atoms before products, each in the order of increasing depth, and starts with a positive
/// term unless all are negative; has at most one constant and no term beside its opposite; a
/// product whose every use is a sum has moved into those sums; a value that outputs want negated
/// more often than not is computed negated.  Values: equal up to rounding, at most one rounding
/// less a product.  Cost: O(nodes log nodes). Needed because one fused operation replaces two,
/// which is worth 11 % of all instructions.
Graph fuse(const Graph& graph);

}  // namespace arboc

// How far two evaluations of a graph may differ that add the terms of its sums in any order, and
// round products inside sums or not.
#pragma once
#include <vector>

#include "graph/graph.h"

namespace arboc::test {

/// Per output entry of the last region, in the order of evaluate().
///
/// Running error analysis, first order with reserve.  A sum of n terms t, in any order and fused or
/// not, errs by at most (n - 1) u sum |t|; every other operation by u of its result (2 u for sines,
/// of which libm's last bit may be wrong); errors of operands are carried on by the derivatives.
/// Both evaluations err so, hence the factor 2.
std::vector<std::vector<double>> rounding_bound(const Graph& graph,
                                                const std::vector<std::vector<double>>& inputs);

}  // namespace arboc::test

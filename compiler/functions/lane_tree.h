// A tree whose limbs are side by side in lanes: of each group one limb is left, and its numbers are
// constants with one value a lane.
//
// Algorithms run on it as on any tree.  Its coordinates stand for one coordinate a limb; where a
// limb meets its parent they add the lanes up (algorithms/limb_sum.h).
#pragma once
#include "graph/expr.h"
#include "tree/limbs.h"

namespace arboc {

struct LaneTree {
  DynamicTreeOf<Expr> tree;
  /// Per entry of its q and v the entries of the whole tree's, one a limb.
  std::vector<std::vector<int>> q, v;
};

/// Without frames.  Groups of three limbs take four lanes, of which the last repeats the third
/// limb.
LaneTree lane_tree(const DynamicTree& tree, const std::vector<LimbGroup>& groups, Builder& builder);

/// Repeats the last of `limbs` values until they fill the lanes of a vector: 1, 2 or 4.
template <class T>
std::vector<T> fill_lanes(std::vector<T> limbs) {
  while (limbs.size() == 3) limbs.push_back(limbs.back());
  return limbs;
}

}  // namespace arboc

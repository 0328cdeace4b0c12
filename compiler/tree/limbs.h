// Isomorphic limbs: subtrees on one body that differ in numbers only.
//
// Legs, arms and fingers repeat: the same joints in the same order, other lengths and masses.  What
// is computed for one of them is computed for all in the lanes of one vector (docs/limbs.md).
#pragma once
#include <string>
#include <vector>

#include "tree/dynamic_tree.h"

namespace arboc {

/// Limbs on one body.  limb[l][k] is the body of limb l that plays part k; part 0 is the root, and
/// a part stands behind its parent.
struct LimbGroup {
  int parent = 0;
  std::vector<std::vector<int>> limb;

  int limbs() const { return static_cast<int>(limb.size()); }
  int parts() const { return static_cast<int>(limb[0].size()); }
};

/// The outermost groups, two to `most` limbs each, in the order of their first limbs.  Limbs of a
/// group have the same tree of joints, the same types, multipliers and offsets; no coordinate of a
/// limb moves anything outside (mimic joints).  Larger groups are divided; a limb that remains
/// alone is in none.  Cost: O(bodies log bodies) comparisons of the subtrees' descriptions.
std::vector<LimbGroup> find_limbs(const DynamicTree& tree, int most);

/// The printed form (`--print=limbs`): one line a group, the links of each limb.
std::string print(const DynamicTree& tree, const std::vector<LimbGroup>& groups);

}  // namespace arboc

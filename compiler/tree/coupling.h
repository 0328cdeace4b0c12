// Which entries of the joint-space inertia matrix, and of its factorisation, can be non-zero.
#pragma once
#include <vector>

#include "tree/dynamic_tree.h"

namespace arboc {

/// DynamicTree::coupled: the bodies on a path from the world couple all their coordinates, and
/// elimination from the last row up adds fill only where mimic joints share a coordinate.
/// `body` holds a tree's bodies, nv its freedoms.  Cost: the size of the result.
std::vector<std::vector<int>> coupling(const std::vector<Body>& body, int nv);

}  // namespace arboc

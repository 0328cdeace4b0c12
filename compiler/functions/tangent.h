// The tangent space of the configuration as coordinates to differentiate by.
//
//   q (+) d:  p + R d_lin, R exp([d_ang]) floating;  (x, y) + Rz(theta) (d_x, d_y), theta + d_theta
//   planar;  q + d for joints of one freedom, a leader moving its followers.  docs/conventions.md
#pragma once
#include <vector>

#include "derive/coordinate.h"
#include "tree/dynamic_tree.h"

namespace arboc {

/// One coordinate an entry of v, given the references of q's entries in `builder`.  The entries of
/// a floating joint's rotation matrix, as rotation_of_quaternion makes them, are barriers: valid
/// for quaternions of norm 1.  The coordinates of a joint of several freedoms are a group.
std::vector<Coordinate> tangent(const DynamicTree& tree, Builder& builder,
                                const std::vector<Ref>& q);

}  // namespace arboc

// Joint Jacobian: q -> the motion subspace of every coordinate, in the world.
//
// Column j is the velocity of the point of the moved bodies that passes the world's origin, and
// their angular velocity, for a unit rate of coordinate j:  (x_k x z, z).
#pragma once
#include "algorithms/placement.h"
#include "algorithms/twist.h"

namespace arboc {

template <class T>
struct JointJacobiansWorkspace {
  Placements<T> placement;

  template <class Tree>
  explicit JointJacobiansWorkspace(const Tree& tree) : placement(tree) {}
};

/// Column of coordinate d of the joint of `body`, about the world's origin.
template <class B, class T>
Twist<T> world_column(const B& body, const BodyPlacement<T>& at, int d) {
  const int c = component(body.motion, d);
  return unit_twist(c, axis(at.row, c % 3), -at.x);
}

/// q (nq) -> J (6 x nv, row-major), linear rows first; followers add to their leader's column.
template <class Tree, class T>
void joint_jacobians(const Tree& tree, JointJacobiansWorkspace<T>& work, const T* q, T* J) {
  work.placement.update(tree, q);
  fill_zero(J, 6 * tree.nv);
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "column");
    for (int d = 0; d < freedoms(body.motion); ++d)
      add_column(body.multiplier, world_column(body, work.placement[k], d), J + body.v + d,
                 tree.nv);
  }
}

}  // namespace arboc

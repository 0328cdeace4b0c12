// Forward kinematics: q -> where the named frames are in the world.
//
// Each row of a body's rotation is carried outward like a vector: row_i = E_i^T row_parent.
#pragma once
#include "algorithms/joint.h"

namespace arboc {

template <class T>
struct FkWorkspace {
  struct Link {
    Vector3<T> row[3];  ///< of the rotation, world axes from body axes
    Vector3<T> x;       ///< m, origin in the world
  };
  Poses<T> pose;
  std::vector<Link> link;

  explicit FkWorkspace(const DynamicTree& tree) : pose(tree), link(tree.body.size()) {
    const T o(0), one(1);
    link[0] = {{{one, o, o}, {o, one, o}, {o, o, one}}, {o, o, o}};
  }
};

/// q (nq) -> per entry of `frames` (indices into tree.frame) the rotation, row-major, and the
/// origin in world axes: 12 numbers a frame.
template <class T>
void fk(const DynamicTree& tree, FkWorkspace<T>& work, const T* q, const std::vector<int>& frames,
        T* out) {
  work.pose.update(tree, q);
  for (int i = 1; i <= tree.nb(); ++i) {
    const Body& body = tree.body[i];
    enter_block(q, body.link, "placement");
    const auto& parent = work.link[body.parent];
    auto& link = work.link[i];
    const Vector3<T>& p = work.pose[i].p;
    for (int r = 0; r < 3; ++r) link.row[r] = down(body, work.pose[i], parent.row[r]);
    link.x =
        parent.x + Vector3<T>{dot(parent.row[0], p), dot(parent.row[1], p), dot(parent.row[2], p)};
  }
  for (const int k : frames) {
    const Frame& frame = tree.frame[k];
    enter_block(q, frame.name, "frame");
    const auto& link = work.link[frame.body];
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) out[3 * r + c] = dot(link.row[r], column(frame.R, c));
      out[9 + r] = link.x[r] + dot(link.row[r], frame.p);
    }
    out += 12;
  }
}

}  // namespace arboc

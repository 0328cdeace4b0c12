// Forward kinematics: q -> where the named frames are in the world.
//
// Each row of a body's rotation is carried outward like a vector: row_i = E_i^T row_parent.
#pragma once
#include "algorithms/joint.h"

namespace arboc {

template <class T>
struct FkWorkspace {
  struct Link {
    Vector3<T> row_x, row_y, row_z;  ///< of the rotation, world axes from body axes
    Vector3<T> x;                    ///< m, origin in the world
  };
  Poses<T> pose;
  std::vector<Link> link;

  template <class Tree>
  explicit FkWorkspace(const Tree& tree) : pose(tree), link(tree.body.size()) {
    const T o(0), one(1);
    link[0] = {{one, o, o}, {o, one, o}, {o, o, one}, {o, o, o}};
  }
};

/// q (nq) -> per entry of `frames` (indices into tree.frame) the rotation, row-major, and the
/// origin in world axes: 12 numbers a frame.
template <class Tree, class T>
void fk(const Tree& tree, FkWorkspace<T>& work, const T* q, const std::vector<int>& frames,
        T* out) {
  work.pose.update(tree, q);
  for (int i = 1; i <= tree.nb(); ++i) {
    const auto& body = tree.body[i];
    enter_block(q, body.link, "placement");
    const JointPose<T>& pose = work.pose[i];
    const auto& parent = work.link[body.parent];
    auto& link = work.link[i];
    link.x = {parent.x.x + dot(parent.row_x, pose.p), parent.x.y + dot(parent.row_y, pose.p),
              parent.x.z + dot(parent.row_z, pose.p)};
    link.row_x = down(body, pose, parent.row_x);
    link.row_y = down(body, pose, parent.row_y);
    link.row_z = down(body, pose, parent.row_z);
  }
  for (const int k : frames) {
    const auto& frame = tree.frame[k];
    enter_block(q, frame.name, "frame");
    const auto& link = work.link[frame.body];
    const auto write_row = [&](const Vector3<T>& row, const T& x, T* rotation, T& position) {
      for (int c = 0; c < 3; ++c)
        rotation[c] = row.x * frame.R(0, c) + row.y * frame.R(1, c) + row.z * frame.R(2, c);
      position = x + dot(row, frame.p);
    };
    write_row(link.row_x, link.x.x, out, out[9]);
    write_row(link.row_y, link.x.y, out + 3, out[10]);
    write_row(link.row_z, link.x.z, out + 6, out[11]);
    out += 12;
  }
}

}  // namespace arboc

// Where the bodies are in the world, for what is reported along the world's axes.
//
// Each row of a body's rotation is carried outward like a vector: row_i = E_i^T row_parent.
#pragma once
#include "algorithms/joint.h"

namespace arboc {

template <class T>
struct BodyPlacement {
  Vector3<T> row[3];   ///< of the rotation, world axes from body axes
  Vector3<T> stem[3];  ///< the same of the axes that Rz(gamma) Rx(alpha) leave: z is the joint's
  Vector3<T> x;        ///< m, origin in the world
};

/// World axes from the axes whose rows are given.
template <class T, class S>
ARBOC_INLINE Vector3<T> turned(const Vector3<T> (&row)[3], const Vector3<S>& a) {
  return {dot(row[0], a), dot(row[1], a), dot(row[2], a)};
}
/// Column k.
template <class T>
Vector3<T> axis(const Vector3<T> (&row)[3], int k) {
  return {row[0][k], row[1][k], row[2][k]};
}

template <class T>
struct Placements {
  Poses<T> pose;
  std::vector<BodyPlacement<T>> body;

  template <class Tree>
  explicit Placements(const Tree& tree) : pose(tree), body(tree.body.size()) {
    const T o(0), one(1);
    body[0].row[0] = {one, o, o};
    body[0].row[1] = {o, one, o};
    body[0].row[2] = {o, o, one};
    body[0].x = {o, o, o};
  }

  /// `from_roots`: positions count from the origins of the bodies that stand on the world.
  template <class Tree>
  void update(const Tree& tree, const T* q, bool from_roots = false) {
    pose.update(tree, q);
    for (int i = 1; i <= tree.nb(); ++i) {
      enter_block(q, tree.body[i].link, "placement");
      place(tree.body[i], pose[i], body[tree.body[i].parent], body[i]);
      if (from_roots && tree.body[i].parent == 0) body[i].x = body[0].x;
    }
  }
  const BodyPlacement<T>& operator[](int i) const { return body[i]; }

 private:
  template <class B>
  static void place(const B& body, const JointPose<T>& pose, const BodyPlacement<T>& parent,
                    BodyPlacement<T>& own) {
    own.x = parent.x + turned(parent.row, pose.p);
    for (int i = 0; i < 3; ++i) {
      own.stem[i] = rotate_back_x(body.alpha, rotate_back_z(body.gamma, parent.row[i]));
      own.row[i] = rotate_back_z(pose.turn, own.stem[i]);
      if (has_quaternion(body.motion)) own.row[i] = transpose_apply(pose.Q, own.row[i]);
    }
  }
};

/// The origin of a named frame, in the world.
template <class F, class T>
Vector3<T> frame_origin(const F& frame, const BodyPlacement<T>& body) {
  return body.x + turned(body.row, cast<T>(frame.p));
}

}  // namespace arboc

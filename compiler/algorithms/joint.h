// One joint: where it puts its body, and vectors carried across it.
//
//   E = Rz(gamma) Rx(alpha) Rz(theta + q)        revolute, planar
//   E = Rz(gamma) Rx(alpha) Rz(theta)            prismatic
//   E = Rz(gamma) Rx(alpha) Rz(theta) R(quat)    floating, spherical
// and x_parent = E x + p.  Sine and cosine are taken of the user's q and then turned by theta:
// q + theta would round, by 0.06 rad at q = 1e15.
#pragma once
#include <vector>

#include "algorithms/block.h"
#include "algorithms/scalar_double.h"
#include "tree/dynamic_tree.h"

namespace arboc {

template <class T>
struct JointPose {
  PlanarRotation<T> turn;  ///< theta, and the joint's angle if it has one
  Vector3<T> p;            ///< m, origin of the body in its parent's frame
  Matrix3<T> Q;            ///< R(quaternion) of a floating or spherical joint, otherwise unused
};

/// The joint's own coordinate, for those that have one.
template <class T>
T coordinate(const Body& body, const T* q) {
  return body.multiplier * q[body.q] + body.offset;
}
/// Entry d of the joint's part of v or a.
template <class T>
T rate(const Body& body, const T* v, int d = 0) {
  return body.multiplier * v[body.v + d];
}

/// Rz(gamma) Rx(alpha) a.
template <class S, class T>
ARBOC_INLINE Vector3<T> out_of_joint(const BodyOf<S>& body, const Vector3<T>& a) {
  return rotate_z(body.gamma, rotate_x(body.alpha, a));
}

/// The pose as far as it does not depend on q.
template <class T, class S>
JointPose<T> constant_pose(const BodyOf<S>& body) {
  JointPose<T> pose;
  pose.turn = cast<T>(body.theta);
  pose.p = cast<T>(body.c);
  return pose;
}

template <class S, class T>
ARBOC_INLINE PlanarRotation<T> joint_turn(const BodyOf<S>& body, const T& angle) {
  PlanarRotation<T> turn;
  sincos(angle, turn.s, turn.c);
  return compose(body.theta, turn);
}

template <class S, class T>
ARBOC_INLINE void update_pose(const BodyOf<S>& body, const T* q, JointPose<T>& pose) {
  switch (body.motion) {
    case Motion::kWorld: break;
    case Motion::kRevolute:
      pose.turn = body.circle ? compose(body.theta, PlanarRotation<T>{q[body.q], q[body.q + 1]})
                              : joint_turn(body, coordinate(body, q));
      break;
    case Motion::kPrismatic: {
      const Vector3<S> axis = out_of_joint(body, Vector3<S>{S(0), S(0), S(1)});
      pose.p = cast<T>(body.c) + coordinate(body, q) * cast<T>(axis);
      break;
    }
    case Motion::kPlanar: {
      const Vector3<T> slide{q[body.q], q[body.q + 1], T(0)};
      pose.p = cast<T>(body.c) + out_of_joint(body, rotate_z(body.theta, slide));
      pose.turn = joint_turn(body, q[body.q + 2]);
      break;
    }
    case Motion::kFloating: {
      const Vector3<T> slide{q[body.q], q[body.q + 1], q[body.q + 2]};
      pose.p = cast<T>(body.c) + out_of_joint(body, rotate_z(body.theta, slide));
      pose.Q = rotation_of_quaternion(q + body.q + 3);
      break;
    }
    case Motion::kSpherical: pose.Q = rotation_of_quaternion(q + body.q); break;
  }
}

/// E a.
template <class S, class T>
ARBOC_INLINE Vector3<T> up(const BodyOf<S>& body, const JointPose<T>& pose, Vector3<T> a) {
  if (has_quaternion(body.motion)) a = pose.Q * a;
  return out_of_joint(body, rotate_z(pose.turn, a));
}
/// E^T a.
template <class S, class T>
ARBOC_INLINE Vector3<T> down(const BodyOf<S>& body, const JointPose<T>& pose, const Vector3<T>& a) {
  Vector3<T> b = rotate_back_z(pose.turn, rotate_back_x(body.alpha, rotate_back_z(body.gamma, a)));
  if (has_quaternion(body.motion)) b = transpose_apply(pose.Q, b);
  return b;
}
/// E A E^T.
template <class S, class T>
ARBOC_INLINE Symmetric3<T> up(const BodyOf<S>& body, const JointPose<T>& pose, Symmetric3<T> A) {
  if (has_quaternion(body.motion)) A = congruence(pose.Q, A);
  return congruence_z(body.gamma, congruence_x(body.alpha, congruence_z(pose.turn, A)));
}
template <class S, class T>
Matrix3<T> up(const BodyOf<S>& body, const JointPose<T>& pose, Matrix3<T> A) {
  if (has_quaternion(body.motion)) A = pose.Q * A * transpose(pose.Q);
  return congruence_z(body.gamma, congruence_x(body.alpha, congruence_z(pose.turn, A)));
}

/// The poses of all joints.
template <class T>
struct Poses {
  std::vector<JointPose<T>> joint;

  template <class Tree>
  explicit Poses(const Tree& tree) {
    joint.reserve(tree.body.size());
    for (const auto& body : tree.body) joint.push_back(constant_pose<T>(body));
  }
  template <class Tree>
  void update(const Tree& tree, const T* q) {
    for (int i = 1; i <= tree.nb(); ++i) {
      enter_block(q, tree.body[i].link, "pose");
      update_pose(tree.body[i], q, joint[i]);
    }
  }
  const JointPose<T>& operator[](int i) const { return joint[i]; }
};

}  // namespace arboc

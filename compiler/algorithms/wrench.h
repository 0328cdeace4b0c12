// Forces on a body, and which of their entries a joint transmits to its coordinates.
#pragma once
#include "algorithms/joint.h"

namespace arboc {

/// Force and moment about the origin of a body's frame, in its axes.
template <class T>
struct Wrench {
  Vector3<T> f;
  Vector3<T> n;

  const T& operator[](int k) const { return k < 3 ? f[k] : n[k - 3]; }
};

/// The same about the origin of the parent's frame, in its axes.
template <class T>
Wrench<T> up(const Body& body, const JointPose<T>& pose, const Wrench<T>& wrench) {
  const Vector3<T> f = up(body, pose, wrench.f);
  return {f, up(body, pose, wrench.n) + cross(pose.p, f)};
}

/// The entry of (linear, angular) that coordinate d of a joint moves, and of the wrench that does
/// work on it: every joint moves along or about axes of the body's frame.
inline int component(Motion motion, int d) {
  switch (motion) {
    case Motion::kRevolute: return 5;
    case Motion::kPrismatic: return 2;
    case Motion::kPlanar: return d == 2 ? 5 : d;
    default: return d;
  }
}

/// Adds what the joint of `body` feels of `wrench` to the generalised forces.
template <class T>
void add_joint_force(const Body& body, const Wrench<T>& wrench, T* tau) {
  const int n = freedoms(body.motion);
  for (int d = 0; d < n; ++d) {
    T& entry = tau[body.v + d];
    entry = entry + body.multiplier * wrench[component(body.motion, d)];
  }
}

}  // namespace arboc

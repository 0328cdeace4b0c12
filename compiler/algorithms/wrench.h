// Forces on a body, and which of their entries a joint transmits to its coordinates.
#pragma once
#include "algorithms/joint.h"
#include "algorithms/limb_sum.h"

namespace arboc {

/// Force and moment about the origin of a body's frame, in its axes.
template <class T>
struct Wrench {
  Vector3<T> f;
  Vector3<T> n;
};

/// The same about the origin of the parent's frame, in its axes.
template <class S, class T>
ARBOC_INLINE Wrench<T> up(const BodyOf<S>& body, const JointPose<T>& pose,
                          const Wrench<T>& wrench) {
  const Vector3<T> f = up(body, pose, wrench.f);
  return {f, up(body, pose, wrench.n) + cross(pose.p, f)};
}

template <class T>
Wrench<T> limb_sum(const Body& body, const Wrench<T>& a) {
  return {limb_sum(body, a.f), limb_sum(body, a.n)};
}

/// The entry of (linear, angular) that coordinate d of a joint moves: every joint moves along or
/// about axes of the body's frame.
inline int component(Motion motion, int d) {
  switch (motion) {
    case Motion::kRevolute: return 5;
    case Motion::kPrismatic: return 2;
    case Motion::kPlanar: return d == 2 ? 5 : d;
    case Motion::kSpherical: return d + 3;
    default: return d;
  }
}

/// Calls use(d, force) for each coordinate d of the joint: what the joint feels of `wrench`.
template <class T, class Use>
ARBOC_INLINE void for_each_joint_force(Motion motion, const Wrench<T>& wrench, Use&& use) {
  const Vector3<T>&f = wrench.f, &n = wrench.n;
  switch (motion) {
    case Motion::kWorld: break;
    case Motion::kRevolute: use(0, n.z); break;
    case Motion::kPrismatic: use(0, f.z); break;
    case Motion::kPlanar:
      use(0, f.x);
      use(1, f.y);
      use(2, n.z);
      break;
    case Motion::kSpherical:
      use(0, n.x);
      use(1, n.y);
      use(2, n.z);
      break;
    case Motion::kFloating:
      use(0, f.x);
      use(1, f.y);
      use(2, f.z);
      use(3, n.x);
      use(4, n.y);
      use(5, n.z);
      break;
  }
}

/// Adds what the joint of `body` feels of `wrench` to the generalised forces.
template <class T>
ARBOC_INLINE void add_joint_force(const Body& body, const Wrench<T>& wrench, T* tau) {
  for_each_joint_force(body.motion, wrench, [&](int d, const T& force) {
    T& entry = tau[body.v + d];
    entry = entry + body.multiplier * force;
  });
}

}  // namespace arboc

// Motion of the links from the world outward, without linear velocities.
//
// dv is the classical acceleration of the frame's origin, and U r that of a point r beyond it,
//   U = [dw] + [w]^2 = [dw] + w w^T - (w.w) 1,
// so one matrix serves the children's origins, the force and the moment.  Gravity enters as an
// acceleration of the world by -g.  docs/theory.md section 3.
#pragma once
#include "algorithms/joint.h"

namespace arboc {

/// Angular velocity, its derivative, acceleration of the origin with gravity: in the body's axes.
template <class T>
struct LinkMotion {
  Vector3<T> w;   ///< rad/s
  Vector3<T> dw;  ///< rad/s^2
  Vector3<T> dv;  ///< m/s^2
  Matrix3<T> U;   ///< 1/s^2
};

/// -g, without negative zeros.
template <class T, class Tree>
Vector3<T> world_acceleration(const Tree& tree) {
  const Vector3<T> g = cast<T>(tree.gravity);
  return {T(0) - g.x, T(0) - g.y, T(0) - g.z};
}

template <class T, class Tree>
LinkMotion<T> world_motion(const Tree& tree) {
  const Vector3<T> zero{T(0), T(0), T(0)};
  const T o(0);
  return {zero, zero, world_acceleration<T>(tree), {{{o, o, o}, {o, o, o}, {o, o, o}}}};
}

template <class T>
ARBOC_INLINE Matrix3<T> acceleration_matrix(const Vector3<T>& w, const Vector3<T>& dw) {
  const T xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  const T xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
  return {{{-(yy + zz), xy - dw.z, xz + dw.y},
           {xy + dw.z, -(xx + zz), yz - dw.x},
           {xz - dw.y, yz + dw.x, -(xx + yy)}}};
}

/// Acceleration entry of a joint; nothing where all accelerations are zero (nle).
template <bool kAccelerated, class T>
T acceleration(const Body& body, const T* a, int d) {
  if constexpr (kAccelerated) return rate(body, a, d);
  return T(0);
}

/// The joint's own motion: body-frame linear velocity l, angular velocity o, and their derivatives.
template <bool kAccelerated, class T>
ARBOC_INLINE void add_joint_motion(const Body& body, const T* v, const T* a, const Vector3<T>& W,
                                   LinkMotion<T>& motion) {
  const auto acc = [&](int d) { return acceleration<kAccelerated>(body, a, d); };
  const auto turn = [&](const T& rate_z, const T& acc_z) {
    motion.w.z = W.z + rate_z;
    motion.dw.x = motion.dw.x + W.y * rate_z;
    motion.dw.y = motion.dw.y - W.x * rate_z;
    motion.dw.z = motion.dw.z + acc_z;
  };
  switch (body.motion) {
    case Motion::kWorld: break;
    case Motion::kRevolute: turn(rate(body, v), acc(0)); break;
    case Motion::kPrismatic: {
      const T twice = T(2) * rate(body, v);
      motion.dv.x = motion.dv.x + W.y * twice;
      motion.dv.y = motion.dv.y - W.x * twice;
      motion.dv.z = motion.dv.z + acc(0);
      break;
    }
    case Motion::kPlanar: {
      const T &lx = v[body.v], &ly = v[body.v + 1];
      turn(v[body.v + 2], acc(2));
      const Vector3<T> s = W + motion.w;
      motion.dv.x = motion.dv.x + (acc(0) - s.z * ly);
      motion.dv.y = motion.dv.y + (acc(1) + s.z * lx);
      motion.dv.z = motion.dv.z + (s.x * ly - s.y * lx);
      break;
    }
    case Motion::kSpherical: {
      const Vector3<T> o{v[body.v], v[body.v + 1], v[body.v + 2]};
      motion.w = W + o;
      motion.dw = motion.dw + cross(W, o) + Vector3<T>{acc(0), acc(1), acc(2)};
      break;
    }
    case Motion::kFloating: {
      const Vector3<T> l{v[body.v], v[body.v + 1], v[body.v + 2]};
      const Vector3<T> o{v[body.v + 3], v[body.v + 4], v[body.v + 5]};
      motion.w = W + o;
      motion.dw = motion.dw + cross(W, o) + Vector3<T>{acc(3), acc(4), acc(5)};
      motion.dv = motion.dv + cross(W + motion.w, l) + Vector3<T>{acc(0), acc(1), acc(2)};
      break;
    }
  }
}

/// Motion of a link from its parent's.
template <bool kAccelerated, class S, class T>
ARBOC_INLINE void advance(const BodyOf<S>& body, const JointPose<T>& pose,
                          const LinkMotion<T>& parent, const T* v, const T* a,
                          LinkMotion<T>& motion) {
  const Vector3<T> W = down(body, pose, parent.w);
  motion.w = W;
  motion.dw = down(body, pose, parent.dw);
  motion.dv = down(body, pose, parent.dv + parent.U * pose.p);
  add_joint_motion<kAccelerated>(body, v, a, W, motion);
  motion.U = acceleration_matrix(motion.w, motion.dw);
}

}  // namespace arboc

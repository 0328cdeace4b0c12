// How the motion of a link changes with the coordinates of its joint.
//
// q changes in the tangent space: the joint moves its body by a small (d, t) along the body's own
// axes, E <- E (1 + [t]), p <- p + E d.  Of the three vectors that arrive from the parent w and dw
// then turn, and dv changes with the place too.  docs/theory.md section 5.
#pragma once
#include "algorithms/link_motion.h"
#include "algorithms/wrench.h"

namespace arboc {

/// Change of a link's motion, along its own axes, by a unit change of a coordinate: a point r of
/// its subtree gains the acceleration  linear + angular x r + 2 rate x r'.
template <class T>
struct Perturbation {
  Vector3<T> rate;     ///< of w
  Vector3<T> angular;  ///< of dw, plus w x rate
  Vector3<T> linear;   ///< of dv
};

/// Those of one coordinate of a joint.
template <class T>
struct CoordinatePerturbation {
  Perturbation<T> q, v;
};

template <class T>
Vector3<T> unit_vector(int k) {
  return {T(k == 0 ? 1 : 0), T(k == 1 ? 1 : 0), T(k == 2 ? 1 : 0)};
}

/// The joint's linear velocity along its body's axes.
template <class T>
Vector3<T> joint_velocity(const Body& body, const T* v) {
  const T o(0);
  switch (body.motion) {
    case Motion::kPrismatic: return {o, o, rate(body, v)};
    case Motion::kPlanar: return {v[body.v], v[body.v + 1], o};
    case Motion::kFloating: return {v[body.v], v[body.v + 1], v[body.v + 2]};
    default: return {o, o, o};
  }
}

/// Joints of several freedoms.  With what the parent gives the body, (W, D, A) and V = [D] + [W]^2:
///   q  rate W x t,  angular V t,        linear A x t + V d + 2 (W x t) x l
///   v  rate t,      angular (W + w) x t,  linear t x l + (W + w) x d
template <class S, class T>
void perturb_freedoms(const BodyOf<S>& body, const JointPose<T>& pose, const LinkMotion<T>& parent,
                      const LinkMotion<T>& motion, const T* v, CoordinatePerturbation<T>* out) {
  const Vector3<T> zero{T(0), T(0), T(0)};
  const Vector3<T> l = joint_velocity(body, v);
  const Vector3<T> W = down(body, pose, parent.w);
  const Vector3<T> A = down(body, pose, parent.dv + parent.U * pose.p);
  const Matrix3<T> V = acceleration_matrix(W, down(body, pose, parent.dw));
  const Vector3<T> s = W + motion.w;
  for (int d = 0; d < freedoms(body.motion); ++d) {
    const int c = component(body.motion, d);
    const Vector3<T> e = unit_vector<T>(c % 3);
    if (c < 3) {
      out[d].q = {zero, zero, column(V, c)};
      out[d].v = {zero, zero, cross(s, e)};
    } else {
      const Vector3<T> rate = cross(W, e);
      out[d].q = {rate, column(V, c % 3), cross(A, e) + T(2) * cross(rate, l)};
      out[d].v = {e, cross(s, e), cross(e, l)};
    }
  }
}

/// Joints of one freedom: the same with t = z, l = 0 or d = z, and V z = U z.
template <class S, class T>
void perturb(const BodyOf<S>& body, const JointPose<T>& pose, const LinkMotion<T>& parent,
             const LinkMotion<T>& motion, const T* v, CoordinatePerturbation<T>* out) {
  const T o(0);
  const Vector3<T> zero{o, o, o};
  const Vector3<T>&w = motion.w, &dv = motion.dv;
  const Vector3<T> coriolis{T(2) * w.y, -(T(2) * w.x), o};
  switch (body.motion) {
    case Motion::kRevolute:
      out->q = {{w.y, -w.x, o}, column(motion.U, 2), {dv.y, -dv.x, o}};
      out->v = {{o, o, T(1)}, coriolis, zero};
      break;
    case Motion::kPrismatic:
      out->q = {zero, zero, column(motion.U, 2)};
      out->v = {zero, zero, coriolis};
      break;
    default: perturb_freedoms(body, pose, parent, motion, v, out);
  }
}

}  // namespace arboc

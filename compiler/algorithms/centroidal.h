// Momentum: q, v, a -> h = A_G v, the centroidal map A_G, and dh/dt.
//
// Column j of A_G is the momentum of the subtree of j, a rigid body, under a unit rate of j
// (docs/theory.md section 4), turned to world axes and moved to the centre of mass.  h and dh are
// not formed from it but from moments of the motion relative to each body, carried inward: with
// r' and r'' of the points behind the joint,
//   P = integral of r' dm,  K = integral of r' r^T dm,  B = of r'' dm,  N = of r x r'' dm.
// A joint of velocity (l, o) with derivatives (al, ao) adds, in this order,
//   P+ = P + o x h + m l,   K+ = K + [o] Sigma + l h^T,
//   B+ = B + o x (P + P+) + ao x h + m al,
//   N+ = N + C(K + K+) o + C(Sigma) ao + h x al,   C(X) = tr(X) 1 - X.
#pragma once
#include "algorithms/crba.h"
#include "algorithms/placement.h"
#include "algorithms/rnea_derivatives.h"
#include "algorithms/twist.h"

namespace arboc {

/// Of a subtree relative to the body at its root, about the body's origin and along its axes.
template <class T>
struct MotionMoments {
  Vector3<T> P;  ///< kg m/s
  Matrix3<T> K;  ///< kg m^2/s
  Vector3<T> B;  ///< kg m/s^2
  Vector3<T> N;  ///< kg m^2/s^2
};

template <class T>
struct CentroidalWorkspace {
  Placements<T> placement;
  std::vector<Composite<T>> composite;
  std::vector<MotionMoments<T>> moments;

  template <class Tree>
  explicit CentroidalWorkspace(const Tree& tree)
      : placement(tree), composite(tree.body.size()), moments(tree.body.size()) {}
};

template <class T>
MotionMoments<T> moments_at_rest() {
  const T o(0);
  return {{o, o, o}, {{{o, o, o}, {o, o, o}, {o, o, o}}}, {o, o, o}, {o, o, o}};
}

template <class T>
Matrix3<T> sum(const Matrix3<T>& A, const Matrix3<T>& B) {
  Matrix3<T> C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C(i, j) = A(i, j) + B(i, j);
  return C;
}
/// a b^T.
template <class T>
Matrix3<T> outer(const Vector3<T>& a, const Vector3<T>& b) {
  Matrix3<T> C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C(i, j) = a[i] * b[j];
  return C;
}

/// What the joint adds.
template <class T>
void move_with_joint(const Composite<T>& C, const Twist<T>& rate, const Twist<T>& gain,
                     MotionMoments<T>& moments) {
  const Vector3<T>&l = rate.linear, &o = rate.angular;
  const MotionMoments<T> before = moments;
  const Matrix3<T> S = full(C.Sigma);
  const Vector3<T> x = cross(o, column(S, 0)), y = cross(o, column(S, 1)),
                   z = cross(o, column(S, 2));
  const Matrix3<T> turning{{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
  moments.P += cross(o, C.h) + C.m * l;
  moments.K = sum(sum(moments.K, turning), outer(l, C.h));
  moments.B += cross(o, before.P + moments.P) + cross(gain.angular, C.h) + C.m * gain.linear;
  moments.N += complement(sum(before.K, moments.K), o) + complement(S, gain.angular) +
               cross(C.h, gain.linear);
}

/// Adds the subtree of a body to its parent's.
template <class B, class T>
void add_motion_moments(const B& body, const JointPose<T>& pose, const MotionMoments<T>& own,
                        MotionMoments<T>& parent) {
  const Vector3<T> P = up(body, pose, own.P), force = up(body, pose, own.B);
  parent.P += P;
  parent.K = sum(parent.K, sum(up(body, pose, own.K), outer(P, pose.p)));
  parent.B += force;
  parent.N += up(body, pose, own.N) + cross(pose.p, force);
}

/// Bodies from the leaves to those that stand on the world.
template <class Tree, class T>
void gather(const Tree& tree, CentroidalWorkspace<T>& work, const T* q, const T* v, const T* a) {
  const Poses<T>& pose = work.placement.pose;
  for (int k = 1; k <= tree.nb(); ++k) {
    work.composite[k] = own_composite<T>(tree.body[k].inertia);
    work.moments[k] = moments_at_rest<T>();
  }
  for (int k = tree.nb(); k > 0; --k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "moments");
    move_with_joint(work.composite[k], joint_twist(body, v), joint_twist(body, a), work.moments[k]);
    if (body.parent == 0) continue;
    add_motion_moments(body, pose[k], work.moments[k], work.moments[body.parent]);
    add_composite(body, pose[k], work.composite[k], work.composite[body.parent]);
  }
}

/// The centre of mass in the world.
template <class Tree, class T>
Vector3<T> center_of_mass(const Tree& tree, const CentroidalWorkspace<T>& work) {
  T m(0);
  Vector3<T> h{T(0), T(0), T(0)};
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& body = tree.body[k];
    if (body.parent != 0) continue;
    const JointPose<T>& pose = work.placement.pose[k];
    const Composite<T>& C = work.composite[k];
    m = m + C.m;
    h = (h + C.m * pose.p) + up(body, pose, C.h);
  }
  return (T(1) / m) * h;
}

/// Momentum of the subtree for a unit rate of coordinate d, in world axes about the point c.
template <class B, class T>
Twist<T> momentum_column(const B& body, const JointPose<T>& pose, const BodyPlacement<T>& at,
                         const Composite<T>& C, const Vector3<T>& c, int d) {
  const auto in_world = [&](const Vector3<T>(&row)[3], const Wrench<T>& wrench) {
    const Vector3<T> f = turned(row, wrench.f);
    return Twist<T>{f, turned(row, wrench.n) + cross(at.x - c, f)};
  };
  const int e = component(body.motion, d);
  if (body.motion != Motion::kRevolute) return in_world(at.row, unit_wrench(C, e));
  // The joint's own turn need not reach the world.
  const Composite<T> stem{C.m, rotate_z(pose.turn, C.h), congruence_z(pose.turn, C.Sigma)};
  return in_world(at.stem, unit_wrench(stem, e));
}

/// Adds what the subtree on a root body has: momentum and its derivative about the point c.
template <class B, class T>
void add_momentum(const B& body, const JointPose<T>& pose, const MotionMoments<T>& own,
                  const Vector3<T>& c, Twist<T>& h, Twist<T>& dh) {
  const Matrix3<T>& K = own.K;
  const Vector3<T> arm = pose.p - c;
  const Vector3<T> L{K(2, 1) - K(1, 2), K(0, 2) - K(2, 0), K(1, 0) - K(0, 1)};
  const Vector3<T> P = up(body, pose, own.P), force = up(body, pose, own.B);
  h += Twist<T>{P, up(body, pose, L) + cross(arm, P)};
  dh += Twist<T>{force, up(body, pose, own.N) + cross(arm, force)};
}

/// q (nq), v, a (nv) -> h (6): linear momentum, angular momentum about the centre of mass, world
/// axes; A (6 x nv, row-major) with h = A v; dh (6), the time derivative of h.
template <class Tree, class T>
void centroidal(const Tree& tree, CentroidalWorkspace<T>& work, const T* q, const T* v, const T* a,
                T* h, T* A, T* dh) {
  const Placements<T>& placement = work.placement;
  work.placement.update(tree, q);
  gather(tree, work, q, v, a);
  const Vector3<T> c = center_of_mass(tree, work);
  Twist<T> momentum = zero_twist<T>(), force = zero_twist<T>();
  fill_zero(A, 6 * tree.nv);
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "momentum");
    for (int d = 0; d < freedoms(body.motion); ++d)
      add_column(body.multiplier,
                 momentum_column(body, placement.pose[k], placement[k], work.composite[k], c, d),
                 A + body.v + d, tree.nv);
    if (body.parent == 0)
      add_momentum(body, placement.pose[k], work.moments[k], c, momentum, force);
  }
  for (int i = 0; i < 3; ++i) {
    h[i] = momentum.linear[i];
    h[3 + i] = momentum.angular[i];
    dh[i] = force.linear[i];
    dh[3 + i] = force.angular[i];
  }
}

}  // namespace arboc

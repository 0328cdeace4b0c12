// Centre of mass of the moving bodies, its velocity and its Jacobian.
//
// First moments h = integral of r dm, as fractions of the whole mass, are carried inward to the
// axes of each parent, and with them P = integral of r' dm relative to the body.  A column of the
// Jacobian is what a joint's unit motion does to the first moment behind it.
// The tree has mass.
#pragma once
#include "algorithms/placement.h"
#include "algorithms/twist.h"

namespace arboc {

/// Of the mass behind a joint, about the origin of its body and along its axes.
template <class T>
struct FirstMoments {
  T m{};         ///< share of the whole mass
  Vector3<T> h;  ///< m
  Vector3<T> P;  ///< m/s, relative to the body
};

template <class T>
struct ComWorkspace {
  Placements<T> placement;
  std::vector<FirstMoments<T>> moments;

  template <class Tree>
  explicit ComWorkspace(const Tree& tree) : placement(tree), moments(tree.body.size()) {}
};

/// Mass of the moving bodies.
template <class T, class Tree>
T total_mass(const Tree& tree) {
  T mass(0);
  for (int k = 1; k <= tree.nb(); ++k) mass = mass + T(tree.body[k].inertia.m);
  return mass;
}

/// Those of each body alone, at rest; zeros for the world.
template <class Tree, class T>
void own_moments(const Tree& tree, std::vector<FirstMoments<T>>& moments) {
  const Vector3<T> zero{T(0), T(0), T(0)};
  const T share = T(1) / total_mass<T>(tree);
  moments[0] = {T(0), zero, zero};
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& inertia = tree.body[k].inertia;
    moments[k] = {share * T(inertia.m), share * cast<T>(inertia.h), zero};
  }
}

/// Adds the subtree of a body to its parent's.
template <class B, class T>
void add_first_moments(const B& body, const JointPose<T>& pose, const FirstMoments<T>& own,
                       FirstMoments<T>& parent) {
  parent.m = parent.m + own.m;
  parent.h = (parent.h + own.m * pose.p) + up(body, pose, own.h);
  parent.P += up(body, pose, own.P);
}

/// q (nq), v (nv) -> c (3; m), vc (3; m/s) in world axes.
template <class Tree, class T>
void com(const Tree& tree, ComWorkspace<T>& work, const T* q, const T* v, T* c, T* vc) {
  work.placement.pose.update(tree, q);
  own_moments(tree, work.moments);
  for (int k = tree.nb(); k > 0; --k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "first moment");
    FirstMoments<T>& own = work.moments[k];
    const Twist<T> joint = joint_twist(body, v);
    own.P += cross(joint.angular, own.h) + own.m * joint.linear;
    add_first_moments(body, work.placement.pose[k], own, work.moments[body.parent]);
  }
  for (int i = 0; i < 3; ++i) {
    c[i] = work.moments[0].h[i];
    vc[i] = work.moments[0].P[i];
  }
}

/// The velocity of the centre of mass for a unit rate of coordinate d, in world axes.
template <class B, class T>
Vector3<T> com_column(const B& body, const JointPose<T>& pose, const BodyPlacement<T>& at,
                      const FirstMoments<T>& moments, int d) {
  const int c = component(body.motion, d);
  if (c < 3) return moments.m * axis(at.row, c);
  if (body.motion == Motion::kRevolute) {  // the joint's own turn need not reach the world
    const Vector3<T> h = rotate_z(pose.turn, moments.h);
    return turned(at.stem, Vector3<T>{-h.y, h.x, T(0)});
  }
  Vector3<T> e{T(0), T(0), T(0)};
  e[c - 3] = T(1);
  return turned(at.row, cross(e, moments.h));
}

/// q (nq) -> J (3 x nv, row-major): vc = J v.
template <class Tree, class T>
void com_jacobian(const Tree& tree, ComWorkspace<T>& work, const T* q, T* J) {
  const Placements<T>& placement = work.placement;
  work.placement.update(tree, q);
  own_moments(tree, work.moments);
  const int n = tree.nv;
  fill_zero(J, 3 * n);
  for (int k = tree.nb(); k > 0; --k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "column");
    for (int d = 0; d < freedoms(body.motion); ++d) {
      const Vector3<T> column =
          com_column(body, placement.pose[k], placement[k], work.moments[k], d);
      for (int i = 0; i < 3; ++i) {
        T& entry = J[i * n + body.v + d];
        entry = entry + body.multiplier * column[i];
      }
    }
    add_first_moments(body, placement.pose[k], work.moments[k], work.moments[body.parent]);
  }
}

}  // namespace arboc

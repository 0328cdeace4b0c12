// Momentum: q, v, a -> h = A_G v, the centroidal map A_G, and dh/dt.
//
// Column j of A_G is the momentum of the subtree of j, a rigid body, under a unit rate of j
// (docs/theory.md section 4), turned to world axes and moved to the centre of mass.  dh is the sum
// of the inertial wrenches of all bodies (section 3) without gravity; carrying moments of relative
// motion inward instead, beside the composites, costs half as much again on a humanoid.
// Positions count from the origin of the body that stands on the world, if there is one only.
#pragma once
#include "algorithms/crba.h"
#include "algorithms/placement.h"
#include "algorithms/rnea.h"
#include "algorithms/twist.h"

namespace arboc {

template <class T>
struct CentroidalWorkspace {
  Placements<T> placement;
  std::vector<Composite<T>> composite;
  RneaWorkspace<T> rnea;

  template <class Tree>
  explicit CentroidalWorkspace(const Tree& tree)
      : placement(tree), composite(tree.body.size()), rnea(tree) {
    const T o(0);
    rnea.motion[0].dv = {o, o, o};
  }
};

/// Whether one body alone stands on the world.
template <class Tree>
bool has_one_root(const Tree& tree) {
  int roots = 0;
  for (const auto& body : tree.body) roots += body.parent == 0 ? 1 : 0;
  return roots == 1;
}

/// Composites and inertial wrenches of the subtrees, complete at the bodies that stand on the
/// world.
template <class Tree, class T>
void gather(const Tree& tree, CentroidalWorkspace<T>& work, const T* q, const T* v, const T* a) {
  const Poses<T>& pose = work.placement.pose;
  RneaWorkspace<T>& rnea = work.rnea;
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "motion");
    advance<true>(body, pose[k], rnea.motion[body.parent], v, a, rnea.motion[k]);
    rnea.wrench[k] = inertial_wrench(body.inertia, rnea.motion[k], rnea.needed[k]);
    work.composite[k] = own_composite<T>(body.inertia);
  }
  for (int k = tree.nb(); k > 0; --k) {
    const auto& body = tree.body[k];
    if (body.parent == 0) continue;
    enter_block(q, body.link, "composite");
    const Wrench<T> carried = up(body, pose[k], rnea.wrench[k]);
    rnea.wrench[body.parent].f += carried.f;
    rnea.wrench[body.parent].n += carried.n;
    add_composite(body, pose[k], work.composite[k], work.composite[body.parent]);
  }
}

/// The centre of mass, from where positions count.
template <class Tree, class T>
Vector3<T> center_of_mass(const Tree& tree, const CentroidalWorkspace<T>& work) {
  T m(0);
  Vector3<T> h{T(0), T(0), T(0)};
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& body = tree.body[k];
    if (body.parent != 0) continue;
    const Composite<T>& C = work.composite[k];
    m = m + C.m;
    h = (h + C.m * work.placement[k].x) + up(body, work.placement.pose[k], C.h);
  }
  return (T(1) / m) * h;
}

/// The same inertia about its centre of mass.
template <class T>
Composite<T> centered(const Composite<T>& C) {
  const Vector3<T>& h = C.h;
  const Vector3<T> r = (T(1) / C.m) * h;
  const Symmetric3<T>& S = C.Sigma;
  const T o(0);
  return {C.m,
          {o, o, o},
          {S.xx - r.x * h.x, S.yy - r.y * h.y, S.zz - r.z * h.z, S.xy - r.x * h.y, S.xz - r.x * h.z,
           S.yz - r.y * h.z}};
}

/// Momentum of the subtree for a unit rate of coordinate d, in world axes about the centre of mass
/// of all, c; `whole`: the subtree is all there is.
template <class B, class T>
Twist<T> momentum_column(const B& body, const JointPose<T>& pose, const BodyPlacement<T>& at,
                         const Composite<T>& C, const Vector3<T>& c, bool whole, int d) {
  const auto in_world = [&](const Vector3<T>(&row)[3], const Composite<T>& turned_composite) {
    const int e = component(body.motion, d);
    const Wrench<T> wrench = unit_wrench(turned_composite, e);
    const Vector3<T> f = turned(row, wrench.f);
    if (whole) return Twist<T>{f, turned(row, unit_wrench(centered(turned_composite), e).n)};
    return Twist<T>{f, turned(row, wrench.n) + cross(at.x - c, f)};
  };
  if (body.motion != Motion::kRevolute) return in_world(at.row, C);
  // The joint's own turn need not reach the world.
  return in_world(at.stem, {C.m, rotate_z(pose.turn, C.h), congruence_z(pose.turn, C.Sigma)});
}

/// q (nq), v, a (nv) -> h (6): linear momentum, angular momentum about the centre of mass, world
/// axes; A (6 x nv, row-major) with h = A v; dh (6), the time derivative of h.
/// The tree has mass.
template <class Tree, class T>
void centroidal(const Tree& tree, CentroidalWorkspace<T>& work, const T* q, const T* v, const T* a,
                T* h, T* A, T* dh) {
  const bool whole = has_one_root(tree);
  const Placements<T>& placement = work.placement;
  work.placement.update(tree, q, whole);
  gather(tree, work, q, v, a);
  const Vector3<T> c = center_of_mass(tree, work);
  Twist<T> momentum = zero_twist<T>(), force = zero_twist<T>();
  fill_zero(A, 6 * tree.nv);
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& body = tree.body[k];
    const bool root = body.parent == 0;
    enter_block(q, body.link, "momentum");
    for (int d = 0; d < freedoms(body.motion); ++d) {
      const Twist<T> column = momentum_column(body, placement.pose[k], placement[k],
                                              work.composite[k], c, whole && root, d);
      add_column(body.multiplier, column, A + body.v + d, tree.nv);
      momentum += rate(body, v, d) * column;
    }
    if (!root) continue;
    const Wrench<T>& wrench = work.rnea.wrench[k];
    const Vector3<T> f = up(body, placement.pose[k], wrench.f);
    force += Twist<T>{f, up(body, placement.pose[k], wrench.n) + cross(placement[k].x - c, f)};
  }
  write_twist(momentum, h);
  write_twist(force, dh);
}

}  // namespace arboc

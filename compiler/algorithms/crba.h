// Joint-space inertia: q -> M.  Composite rigid bodies with second moments,
// docs/theory.md section 4.
//
// Column j is the wrench on the subtree of j under a unit acceleration of coordinate j, felt at j
// and, carried up, at every ancestor.  Bodies on different branches share no entry.
#pragma once
#include "algorithms/joint_forces.h"
#include "algorithms/wrench.h"

namespace arboc {

/// Upper triangle in a dense row-major array: the simplest M that crba, ltdl and minv write to.
/// They ask for M(i, j) with i <= j only.
template <class T>
struct UpperTriangle {
  T* data = nullptr;
  int n = 0;
  T& operator()(int i, int j) const { return data[i * n + j]; }
};

/// Inertia of a subtree about the origin of a body's frame and in its axes.
template <class T>
struct Composite {
  T m{};
  Vector3<T> h;
  Symmetric3<T> Sigma;
};

template <class T>
struct CrbaWorkspace {
  Poses<T> pose;
  std::vector<Composite<T>> composite;

  template <class Tree>
  explicit CrbaWorkspace(const Tree& tree) : pose(tree), composite(tree.body.size()) {}
};

/// That of a body alone.
template <class T, class S>
Composite<T> own_composite(const MassMomentsOf<S>& I) {
  return {T(I.m), cast<T>(I.h), cast<T>(I.Sigma)};
}

/// The wrench that gives the subtree a unit acceleration in `component` of (linear, angular).
template <class T>
ARBOC_INLINE Wrench<T> unit_wrench(const Composite<T>& C, int component) {
  const T o(0);
  const Vector3<T>& h = C.h;
  const Symmetric3<T>& S = C.Sigma;
  switch (component) {
    case 0: return {{C.m, o, o}, {o, h.z, -h.y}};
    case 1: return {{o, C.m, o}, {-h.z, o, h.x}};
    case 2: return {{o, o, C.m}, {h.y, -h.x, o}};
    case 3: return {{o, -h.z, h.y}, {S.yy + S.zz, -S.xy, -S.xz}};
    case 4: return {{h.z, o, -h.x}, {-S.xy, S.xx + S.zz, -S.yz}};
    default: return {{-h.y, h.x, o}, {-S.xz, -S.yz, S.xx + S.yy}};
  }
}

/// Adds the subtree of a body to its parent's: with h' = E h
///   h += h' + m p,   Sigma += E Sigma E^T + h' p^T + p h'^T + m p p^T.
/// What is constant where p is (m p, m p p^T) meets the parent's own constants first and folds.
template <class S, class T>
ARBOC_INLINE void add_composite(const BodyOf<S>& body, const JointPose<T>& pose,
                                const Composite<T>& C, Composite<T>& parent) {
  const Vector3<T> h = up(body, pose, C.h);
  const Symmetric3<T> I = up(body, pose, C.Sigma);
  const Vector3<T>& p = pose.p;
  const Vector3<T> mp = C.m * p;
  const Symmetric3<T> still{mp.x * p.x, mp.y * p.y, mp.z * p.z, mp.x * p.y, mp.x * p.z, mp.y * p.z};
  const Symmetric3<T> moving{I.xx + (T(2) * p.x) * h.x,      I.yy + (T(2) * p.y) * h.y,
                             I.zz + (T(2) * p.z) * h.z,      I.xy + (h.x * p.y + h.y * p.x),
                             I.xz + (h.x * p.z + h.z * p.x), I.yz + (h.y * p.z + h.z * p.y)};
  parent.m = parent.m + limb_sum(body, C.m);
  parent.h = (parent.h + limb_sum(body, mp)) + limb_sum(body, h);
  parent.Sigma += limb_sum(body, still);
  parent.Sigma += limb_sum(body, moving);
}

/// Adds what the joint of body k feels of a unit acceleration of coordinate d of body j.
template <class T, class Matrix>
ARBOC_INLINE void add_entries(const Body& row, const Body& column, int d, const Wrench<T>& wrench,
                              Matrix& M) {
  const int c = column.v + d;
  const bool same_body = &row == &column;
  for_each_joint_force(row.motion, wrench, [&](int e, const T& force) {
    const int r = row.v + e;
    if (same_body && e > d) return;
    // Mimic joints: M = G^T M' G.  Two of one coordinate meet on its diagonal, once each way.
    const double factor = row.multiplier * column.multiplier * (r == c && !same_body ? 2 : 1);
    T& entry = r < c ? M(r, c) : M(c, r);
    entry = entry + factor * force;
  });
}

/// The recursion behind crba; the poses are up to date.
template <class Tree, class T, class Matrix>
void composite_bodies(const Tree& tree, const Poses<T>& pose, std::vector<Composite<T>>& composite,
                      const T* q, Matrix& M) {
  for (int j = 0; j < tree.nv; ++j) {
    M(j, j) = T(0);
    for (const int i : tree.coupled[j]) M(i, j) = T(0);
  }
  for (int i = 1; i <= tree.nb(); ++i) composite[i] = own_composite<T>(tree.body[i].inertia);
  for (int j = tree.nb(); j > 0; --j) {
    const auto& body = tree.body[j];
    enter_block(q, body.link, "column");
    for (int d = 0; d < freedoms(body.motion); ++d) {
      Wrench<T> wrench = unit_wrench(composite[j], component(body.motion, d));
      add_entries(body, body, d, wrench, M);
      for (int k = j; tree.body[k].parent != 0;) {
        wrench = up(tree.body[k], pose[k], wrench);
        k = tree.body[k].parent;
        add_entries(tree.body[k], body, d, wrench, M);
        next_step(q);
      }
    }
    if (body.parent == 0) continue;
    enter_block(q, body.link, "composite");
    add_composite(body, pose[j], composite[j], composite[body.parent]);
  }
  add_rotors(tree, M);
}

/// q (nq) -> M(j, j) and M(i, j) for i in tree.coupled[j]; no other entry is touched.
/// Matrix: T& operator()(int i, int j), asked for i <= j.
template <class Tree, class T, class Matrix>
void crba(const Tree& tree, CrbaWorkspace<T>& work, const T* q, Matrix&& M) {
  work.pose.update(tree, q);
  composite_bodies(tree, work.pose, work.composite, q, M);
}

}  // namespace arboc

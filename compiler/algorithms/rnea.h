// Inverse dynamics: q, v, a -> tau.  Newton-Euler with second moments, docs/theory.md section 3.
//
//   f = m dv + U h,   n = ax(U Sigma) + h x dv,   ax(P) = (P_zy - P_yz, P_xz - P_zx, P_yx - P_xy)
// The moment is I dw + w x I w in 18 products: only the 6 off-diagonal entries of U Sigma occur.
#pragma once
#include "algorithms/external.h"
#include "algorithms/joint_forces.h"
#include "algorithms/link_motion.h"
#include "algorithms/wrench.h"

namespace arboc {

/// Which diagonal entries of U a body needs whatever its moment is: those that meet a non-zero
/// component of its first moment or of a child's origin.
struct NeededDiagonal {
  bool entry[3] = {false, false, false};
};

template <class Tree>
std::vector<NeededDiagonal> needed_diagonals(const Tree& tree) {
  std::vector<NeededDiagonal> needed(tree.body.size());
  for (const auto& body : tree.body) {
    if (body.motion == Motion::kWorld) continue;
    NeededDiagonal& own = needed[&body - tree.body.data()];
    NeededDiagonal& parent = needed[body.parent];
    for (int k = 0; k < 3; ++k) {
      own.entry[k] = own.entry[k] || !vanishes(body.inertia.h[k]);
      const bool slides = body.motion != Motion::kRevolute && body.motion != Motion::kSpherical;
      parent.entry[k] = parent.entry[k] || !vanishes(body.c[k]) || slides;
    }
  }
  return needed;
}

template <class T>
struct RneaWorkspace {
  Poses<T> pose;
  std::vector<LinkMotion<T>> motion;
  std::vector<Wrench<T>> wrench;
  std::vector<NeededDiagonal> needed;

  template <class Tree>
  explicit RneaWorkspace(const Tree& tree)
      : pose(tree),
        motion(tree.body.size()),
        wrench(tree.body.size()),
        needed(needed_diagonals(tree)) {
    motion[0] = world_motion<T>(tree);
  }
};

/// Component i of ax(U Sigma), (i, j, k) cyclic, with d = (Sigma_ij, Sigma_ik, Sigma_jk, Sigma_jj,
/// Sigma_kk).  Where constants coincide or U's diagonal is not needed otherwise, shorter forms:
///   U_kj - U_jk = 2 dw_i,   U_kk - U_jj = w_k^2 - w_j^2.
template <class S, class T>
ARBOC_INLINE T moment_component(const LinkMotion<T>& motion, const NeededDiagonal& needed, int i,
                                const S (&d)[5]) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const Matrix3<T>& U = motion.U;
  const Vector3<T>& w = motion.w;
  const T turning =
      coincide(d[3], d[4]) ? (S(2) * d[3]) * motion.dw[i] : d[3] * U(k, j) - d[4] * U(j, k);
  const T stretching = needed.entry[j] && needed.entry[k] ? d[2] * U(k, k) - d[2] * U(j, j)
                                                          : d[2] * (w[k] * w[k] - w[j] * w[j]);
  return (d[0] * U(k, i) - d[1] * U(j, i)) + turning + stretching;
}

/// What must act on a body so that it moves like this.
template <class S, class T>
ARBOC_INLINE Wrench<T> inertial_wrench(const MassMomentsOf<S>& inertia, const LinkMotion<T>& motion,
                                       const NeededDiagonal& needed) {
  const Symmetric3<S>& I = inertia.Sigma;
  const Vector3<T> h = cast<T>(inertia.h);
  const Vector3<T> moment{moment_component(motion, needed, 0, {I.xy, I.xz, I.yz, I.yy, I.zz}),
                          moment_component(motion, needed, 1, {I.yz, I.xy, I.xz, I.zz, I.xx}),
                          moment_component(motion, needed, 2, {I.xz, I.yz, I.xy, I.xx, I.yy})};
  return {inertia.m * motion.dv + motion.U * h, moment + cross(h, motion.dv)};
}

/// Motions and wrenches of all links, from the world outward; the poses are up to date.
template <bool kAccelerated, class Tree, class T>
void sweep_out(const Tree& tree, const Poses<T>& pose, RneaWorkspace<T>& work, const T* q,
               const T* v, const T* a) {
  for (int i = 1; i <= tree.nb(); ++i) {
    const auto& body = tree.body[i];
    enter_block(q, body.link, "motion");
    advance<kAccelerated>(body, pose[i], work.motion[body.parent], v, a, work.motion[i]);
    next_step(q);
    work.wrench[i] = inertial_wrench(body.inertia, work.motion[i], work.needed[i]);
  }
}

/// Carries the wrenches to the world; what the joints feel of them goes to tau.
template <class Tree, class T>
void sweep_in(const Tree& tree, const Poses<T>& pose, RneaWorkspace<T>& work, const T* q, T* tau) {
  for (int k = 0; k < tree.nv; ++k) tau[k] = T(0);
  for (int i = tree.nb(); i > 0; --i) {
    const auto& body = tree.body[i];
    enter_block(q, body.link, "force");
    add_joint_force(body, work.wrench[i], tau);
    if (body.parent == 0) continue;
    const Wrench<T> carried = limb_sum(body, up(body, pose[i], work.wrench[i]));
    Wrench<T>& parent = work.wrench[body.parent];
    parent.f += carried.f;
    parent.n += carried.n;
  }
}

/// The recursion behind rnea and nle; the poses are up to date.
template <bool kAccelerated, class Tree, class T>
void newton_euler(const Tree& tree, const Poses<T>& pose, RneaWorkspace<T>& work, const T* q,
                  const T* v, const T* a, T* tau, const FrameLoads<T>* loads = nullptr) {
  sweep_out<kAccelerated>(tree, pose, work, q, v, a);
  if (loads) subtract_loads(tree, pose, *loads, work.wrench);
  sweep_in(tree, pose, work, q, tau);
  if (tree.joint_forces) add_joint_forces<kAccelerated>(tree, q, v, a, tau);
}

/// q (nq), v, a (nv) -> tau (nv): joint forces that produce the acceleration a under
/// the loads.
template <class Tree, class T>
void rnea(const Tree& tree, RneaWorkspace<T>& work, const T* q, const T* v, const T* a, T* tau,
          const FrameLoads<T>* loads = nullptr) {
  work.pose.update(tree, q);
  newton_euler<true>(tree, work.pose, work, q, v, a, tau, loads);
}

}  // namespace arboc

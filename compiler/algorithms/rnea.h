// Inverse dynamics: q, v, a -> tau.  Newton-Euler with second moments, RECURSIONS section 3.
//
//   f = m dv + U h,   n = ax(U Sigma) + h x dv,   ax(P) = (P_zy - P_yz, P_xz - P_zx, P_yx - P_xy)
// The moment is I dw + w x I w in 18 products: only the 6 off-diagonal entries of U Sigma occur.
#pragma once
#include "algorithms/link_motion.h"
#include "algorithms/wrench.h"

namespace arboc {

template <class T>
struct RneaWorkspace {
  Poses<T> pose;
  std::vector<LinkMotion<T>> motion;
  std::vector<Wrench<T>> wrench;

  explicit RneaWorkspace(const DynamicTree& tree)
      : pose(tree), motion(tree.body.size()), wrench(tree.body.size()) {
    motion[0] = world_motion<T>(tree);
  }
};

/// What must act on a body so that it moves like this.
template <class T>
ARBOC_INLINE Wrench<T> inertial_wrench(const MassMoments& inertia, const LinkMotion<T>& motion) {
  const Matrix3<T>& U = motion.U;
  const Symmetric3<double>& S = inertia.Sigma;
  const Vector3<T> h = cast<T>(inertia.h);
  const Vector3<T> moment{S.xy * U(2, 0) + S.yy * U(2, 1) + S.yz * U(2, 2) -
                              (S.xz * U(1, 0) + S.yz * U(1, 1) + S.zz * U(1, 2)),
                          S.xz * U(0, 0) + S.yz * U(0, 1) + S.zz * U(0, 2) -
                              (S.xx * U(2, 0) + S.xy * U(2, 1) + S.xz * U(2, 2)),
                          S.xx * U(1, 0) + S.xy * U(1, 1) + S.xz * U(1, 2) -
                              (S.xy * U(0, 0) + S.yy * U(0, 1) + S.yz * U(0, 2))};
  return {inertia.m * motion.dv + U * h, moment + cross(h, motion.dv)};
}

/// The recursion behind rnea and nle; the poses in the workspace are up to date.
template <bool kAccelerated, class T>
void newton_euler(const DynamicTree& tree, const Poses<T>& pose, RneaWorkspace<T>& work, const T* q,
                  const T* v, const T* a, T* tau) {
  for (int i = 1; i <= tree.nb(); ++i) {
    const Body& body = tree.body[i];
    enter_block(q, body.link, "motion");
    advance<kAccelerated>(body, pose[i], work.motion[body.parent], v, a, work.motion[i]);
    work.wrench[i] = inertial_wrench(body.inertia, work.motion[i]);
  }
  for (int k = 0; k < tree.nv; ++k) tau[k] = T(0);
  for (int i = tree.nb(); i > 0; --i) {
    const Body& body = tree.body[i];
    enter_block(q, body.link, "force");
    add_joint_force(body, work.wrench[i], tau);
    if (body.parent == 0) continue;
    const Wrench<T> carried = up(body, pose[i], work.wrench[i]);
    Wrench<T>& parent = work.wrench[body.parent];
    parent.f += carried.f;
    parent.n += carried.n;
  }
}

/// q (nq), v, a (nv) -> tau (nv): joint forces that produce the acceleration a.
template <class T>
void rnea(const DynamicTree& tree, RneaWorkspace<T>& work, const T* q, const T* v, const T* a,
          T* tau) {
  work.pose.update(tree, q);
  newton_euler<true>(tree, work.pose, work, q, v, a, tau);
}

}  // namespace arboc

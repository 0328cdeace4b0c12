// Forward dynamics: q, v, tau -> qdd, as M qdd = tau - nle with the sparse factorisation of M.
//
// Named for what it computes, as elsewhere; traced and folded this needs fewer operations than the
// articulated-body recursion up to some 50 coordinates.
#pragma once
#include "algorithms/crba.h"
#include "algorithms/ltdl.h"
#include "algorithms/nle.h"

namespace arboc {

template <class T>
struct AbaWorkspace {
  RneaWorkspace<T> bias;  ///< its poses serve M as well
  std::vector<Composite<T>> composite;
  std::vector<T> M;          ///< nv x nv, row-major, upper triangle
  std::vector<T> D_inverse;  ///< nv
  std::vector<int> body;     ///< per coordinate

  template <class Tree>
  explicit AbaWorkspace(const Tree& tree)
      : bias(tree),
        composite(tree.body.size()),
        M(static_cast<size_t>(tree.nv) * tree.nv),
        D_inverse(tree.nv),
        body(body_of_coordinate(tree)) {}
};

/// How far a pivot D_k must stay from rounding, as a part of M_kk, from which D_k comes by
/// subtraction: below it not even the sign of D_k can be trusted.
inline constexpr double kLostPivot = 0x1p-46;  // 64 eps

/// q (nq), v, tau (nv) -> qdd (nv) and the pivots of M (nv), less what rounding may have left of
/// them.  One that is not positive says that M is not positive definite, or that it cannot be told
/// from a matrix that is not, and then qdd means nothing.
template <class Tree, class T>
void aba(const Tree& tree, AbaWorkspace<T>& work, const T* q, const T* v, const T* tau, T* qdd,
         T* pivots, const FrameLoads<T>* loads = nullptr) {
  Poses<T>& pose = work.bias.pose;
  pose.update(tree, q);
  newton_euler<false>(tree, pose, work.bias, q, v, static_cast<const T*>(nullptr), qdd, loads);
  for (int k = 0; k < tree.nv; ++k) qdd[k] = tau[k] - qdd[k];
  UpperTriangle<T> M{work.M.data(), tree.nv};
  composite_bodies(tree, pose, work.composite, q, M);
  for (int k = 0; k < tree.nv; ++k) pivots[k] = M(k, k);
  ltdl(tree, work.body, q, M, work.D_inverse.data());
  for (int k = 0; k < tree.nv; ++k)
    pivots[k] = coincide(M(k, k), pivots[k]) ? pivots[k] : M(k, k) - T(kLostPivot) * pivots[k];
  enter_block(q, tree.body[1].link, "solve");
  solve(tree, M, work.D_inverse.data(), q, qdd);
}

}  // namespace arboc

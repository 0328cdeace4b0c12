// Nonlinear effects: q, v -> C(q, v) v + g(q), inverse dynamics at zero acceleration.
#pragma once
#include "algorithms/rnea.h"

namespace arboc {

/// q (nq), v (nv) -> nle (nv).
template <class Tree, class T>
void nle(const Tree& tree, RneaWorkspace<T>& work, const T* q, const T* v, T* nle,
         const FrameLoads<T>* loads = nullptr) {
  work.pose.update(tree, q);
  newton_euler<false>(tree, work.pose, work, q, v, static_cast<const T*>(nullptr), nle, loads);
}

}  // namespace arboc

// First derivatives of forward dynamics: q, v, tau -> dqdd/dq, dqdd/dv, dqdd/dtau = M^-1.
//
// From M qdd = tau - nle:  dqdd/dx = -M^-1 (d rnea/dx)(q, v, qdd), with the factors of M that
// forward dynamics has already.  [CM18] section V.
#pragma once
#include "algorithms/aba.h"
#include "algorithms/minv.h"
#include "algorithms/rnea_derivatives.h"

namespace arboc {

template <class T>
struct AbaDerivativesWorkspace {
  AbaWorkspace<T> aba;
  RneaDerivativesWorkspace<T> derivatives;
  InverseWorkspace<T> inverse;
  std::vector<T> qdd;     ///< nv
  std::vector<T> column;  ///< nv
  std::vector<T> dq, dv;  ///< nv x nv, of tau
  std::vector<T> M;       ///< nv x nv, not used

  template <class Tree>
  explicit AbaDerivativesWorkspace(const Tree& tree)
      : aba(tree),
        derivatives(tree),
        inverse(tree),
        qdd(tree.nv),
        column(tree.nv),
        dq(static_cast<size_t>(tree.nv) * tree.nv),
        dv(dq.size()),
        M(dq.size()) {}
};

/// q (nq), v, tau (nv) -> dqdd_dq, dqdd_dv (nv x nv, every entry), Minv (i, j) for i <= j, and the
/// pivots of M (nv).
template <class Tree, class T, class Square, class Upper>
void aba_derivatives(const Tree& tree, AbaDerivativesWorkspace<T>& work, const T* q, const T* v,
                     const T* tau, Square&& dqdd_dq, Square&& dqdd_dv, Upper&& Minv, T* pivots,
                     const FrameLoads<T>* loads = nullptr) {
  const int n = tree.nv;
  aba(tree, work.aba, q, v, tau, work.qdd.data(), pivots, loads);
  const SquareMatrix<T> dq{work.dq.data(), n}, dv{work.dv.data(), n};
  rnea_derivatives(tree, work.derivatives, q, v, work.qdd.data(), dq, dv,
                   UpperTriangle<T>{work.M.data(), n}, loads);
  const UpperTriangle<T> LD{work.aba.M.data(), n};
  const T* D_inverse = work.aba.D_inverse.data();
  const auto divide = [&](const SquareMatrix<T>& A, const auto& X) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) work.column[i] = -A(i, j);
      solve(tree, LD, D_inverse, q, work.column.data());
      for (int i = 0; i < n; ++i) X(i, j) = work.column[i];
    }
  };
  enter_block(q, tree.body[1].link, "solve");
  divide(dq, dqdd_dq);
  divide(dv, dqdd_dv);
  inverse(tree, work.inverse, work.aba.body, q, LD, D_inverse, Minv);
}

}  // namespace arboc

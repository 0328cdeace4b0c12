// The inverse of the joint-space inertia: q -> M^-1 = W D^-1 W^T with W = L^-1.
//
// Row k of W lives on the elimination path of k (the nearest coupled coordinate, the nearest of
// that, ...), so an entry of M^-1 is a sum over the paths' common part only.
#pragma once
#include "algorithms/crba.h"
#include "algorithms/ltdl.h"

namespace arboc {

template <class T>
struct InverseWorkspace {
  std::vector<T> W;                    ///< nv x nv, W(k, j) at row k
  std::vector<T> V;                    ///< W D^-1
  std::vector<std::vector<int>> path;  ///< per coordinate its elimination path, itself first

  template <class Tree>
  explicit InverseWorkspace(const Tree& tree)
      : W(static_cast<size_t>(tree.nv) * tree.nv), V(W.size()) {
    for (int k = 0; k < tree.nv; ++k) {
      path.push_back({k});
      if (tree.coupled[k].empty()) continue;
      const std::vector<int>& rest = path[tree.coupled[k].front()];
      path[k].insert(path[k].end(), rest.begin(), rest.end());
    }
  }
};

/// Row k of W = L^-1: x <- L^-T e_k, which is zero outside the path.
template <class Tree, class T, class Matrix>
void invert_row(const Tree& tree, InverseWorkspace<T>& work, const Matrix& L, const T* D_inverse,
                int k) {
  T* x = work.W.data() + static_cast<size_t>(k) * tree.nv;
  T* y = work.V.data() + static_cast<size_t>(k) * tree.nv;
  for (int j = 0; j < tree.nv; ++j) x[j] = y[j] = T(0);
  x[k] = T(1);
  for (const int j : work.path[k]) {
    for (const int i : tree.coupled[j]) x[i] = x[i] - L(i, j) * x[j];
    y[j] = x[j] * D_inverse[j];
  }
}

/// (L^T D L)^-1 (i, j) for all i <= j from the factors; zero where no path is shared.
template <class Tree, class T, class Factors, class Matrix>
void inverse(const Tree& tree, InverseWorkspace<T>& work, const std::vector<int>& body, const T* q,
             const Factors& LD, const T* D_inverse, Matrix&& Minv) {
  const int n = tree.nv;
  for (int k = 0; k < n; ++k) {
    enter_block(q, tree.body[body[k]].link, "inverse");
    invert_row(tree, work, LD, D_inverse, k);
    const T* V = work.V.data() + static_cast<size_t>(k) * n;
    for (int i = 0; i <= k; ++i) {
      const T* W = work.W.data() + static_cast<size_t>(i) * n;
      T sum(0);
      for (const int j : work.path[i]) sum = sum + W[j] * V[j];
      Minv(i, k) = sum;
    }
  }
}

template <class T>
struct MinvWorkspace {
  CrbaWorkspace<T> crba;
  InverseWorkspace<T> inverse;
  std::vector<T> M;          ///< nv x nv: L and D in the upper triangle
  std::vector<T> D_inverse;  ///< nv
  std::vector<int> body;     ///< per coordinate

  template <class Tree>
  explicit MinvWorkspace(const Tree& tree)
      : crba(tree),
        inverse(tree),
        M(static_cast<size_t>(tree.nv) * tree.nv),
        D_inverse(tree.nv),
        body(body_of_coordinate(tree)) {}
};

/// q (nq) -> Minv(i, j) for all i <= j.
/// Matrix: T& operator()(int i, int j), asked for i <= j.
template <class Tree, class T, class Matrix>
void minv(const Tree& tree, MinvWorkspace<T>& work, const T* q, Matrix&& Minv) {
  UpperTriangle<T> M{work.M.data(), tree.nv};
  crba(tree, work.crba, q, M);
  ltdl(tree, work.body, q, M, work.D_inverse.data());
  inverse(tree, work.inverse, work.body, q, M, work.D_inverse.data(), Minv);
}

}  // namespace arboc

// M = L^T D L without fill between branches, and solutions with it.  [RBDA] section 6.5, Table 6.3.
//
// L is unit lower triangular; L(j, i) stands in M(i, j), D on the diagonal.  Elimination runs from
// the last row up, so entries exist only where tree.coupled says.
#pragma once
#include <string>
#include <vector>

#include "algorithms/block.h"
#include "algorithms/limb_sum.h"
#include "tree/dynamic_tree.h"

namespace arboc {

/// Per coordinate a link that it moves: whose block the work on its row belongs to.
template <class Tree>
std::vector<int> body_of_coordinate(const Tree& tree) {
  std::vector<int> body(tree.nv);
  for (int i = tree.nb(); i > 0; --i)
    for (int d = 0; d < freedoms(tree.body[i].motion); ++d) body[tree.body[i].v + d] = i;
  return body;
}

/// Factorises in place; D_inverse (nv) receives the reciprocals of the pivots.
template <class Tree, class T, class Matrix>
void ltdl(const Tree& tree, const std::vector<int>& body, const T* q, Matrix& M, T* D_inverse) {
  for (int k = tree.nv - 1; k >= 0; --k) {
    enter_block(q, tree.body[body[k]].link, "factor");
    const std::vector<int>& row = tree.coupled[k];
    D_inverse[k] = T(1) / M(k, k);
    for (size_t a = 0; a < row.size(); ++a) {
      const int i = row[a];
      const T l = M(i, k) * D_inverse[k];
      for (size_t b = a; b < row.size(); ++b)
        M(row[b], i) = M(row[b], i) - limb_sum(tree, k, i, row[b], l * M(row[b], k));
      M(i, k) = l;
    }
  }
}

/// x <- (L^T D L)^-1 x.  q: where the step of a trace is kept.
template <class Tree, class T, class Matrix>
void solve(const Tree& tree, const Matrix& LD, const T* D_inverse, const T* q, T* x) {
  for (int k = tree.nv - 1; k >= 0; --k) {
    next_step(q);
    for (const int i : tree.coupled[k]) x[i] = x[i] - limb_sum(tree, k, i, i, LD(i, k) * x[k]);
    x[k] = x[k] * D_inverse[k];
  }
  for (int k = 0; k < tree.nv; ++k) {
    next_step(q);
    for (const int i : tree.coupled[k]) x[k] = x[k] - LD(i, k) * x[i];
  }
}

}  // namespace arboc

// Isomorphic limbs in lanes: one body stands for several, and its parent gets the sum of their
// shares.  Of numbers there is one limb a body, and nothing is added.
#pragma once
#include "tree/dynamic_tree.h"

namespace arboc {

/// The sum of the first n lanes; the traced scalar's overload is found through its argument.
template <class T>
T hsum(const T& x, int /*n*/) {
  return x;
}

/// What the parent of a body gets of x.
template <class T>
ARBOC_INLINE T limb_sum(const Body& body, const T& x) {
  return body.limbs > 1 ? hsum(x, body.limbs) : x;
}
template <class T>
ARBOC_INLINE Vector3<T> limb_sum(const Body& body, const Vector3<T>& a) {
  return {limb_sum(body, a.x), limb_sum(body, a.y), limb_sum(body, a.z)};
}
template <class T>
ARBOC_INLINE Symmetric3<T> limb_sum(const Body& body, const Symmetric3<T>& A) {
  return {limb_sum(body, A.xx), limb_sum(body, A.yy), limb_sum(body, A.zz),
          limb_sum(body, A.xy), limb_sum(body, A.xz), limb_sum(body, A.yz)};
}

/// What an entry of coordinates i and j gets of row k, of which i and j are ancestors.
template <class Tree, class T>
ARBOC_INLINE T limb_sum(const Tree& tree, int k, int i, int j, const T& x) {
  if (tree.lanes.empty()) return x;
  const bool crosses = tree.lanes[i] == 1 && tree.lanes[j] == 1 && tree.lanes[k] > 1;
  return crosses ? hsum(x, tree.lanes[k]) : x;
}

}  // namespace arboc

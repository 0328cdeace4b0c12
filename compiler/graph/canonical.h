// Puts a trace into an order that depends on nothing but what was traced.
//
// C++ leaves open which operand of f(a) + g(b) is evaluated first, so builds of this program by
// different compilers make the same nodes in different orders; and the sign that a sum carries
// inside, the order of its operands, and in derivatives the order of whole sums follow from the
// order of the nodes.  What is fixed is the set of nodes and the step (enter_block, next_step) in
// which each is made first.  So nodes get labels by induction: step by step, in it level by level
// (the longest path within the step), and in a level in the order of operation and operands'
// labels, which no two nodes share.
#pragma once
#include <vector>

#include "graph/builder.h"
#include "graph/expr.h"

namespace arboc {

enum class NodeOrder {
  kByCones,   ///< a node right behind what it needs of its step: values are used soon; for emission
  kByLevels,  ///< in the order of the labels: sums of adjoints share most; for derivation
};

/// Before: what a Builder was told by one thread, without n-ary sums.  After: the same without what
/// `roots` do not need, in the order of the steps.  Returns the roots in the new builder.  Values:
/// the same bits, up to the order of the two operands of an operation.  Cost: O(nodes log nodes).
std::vector<Ref> canonicalise(Builder& builder, const std::vector<Ref>& roots, NodeOrder order);
/// The same of traced scalars, in place.
void canonicalise(Builder& builder, const std::vector<Expr*>& roots, NodeOrder order);

}  // namespace arboc

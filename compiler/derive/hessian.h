// Second derivatives: sweeps over the nodes of the gradient.
//
// With E_i the derivative along coordinate i, the gradient (E_i f)_i differentiated along j gives
// the iterated derivatives E_j(E_i f).  Coordinates of one group do not commute (turns about a
// body's axes, its own moves): there the symmetric second derivative, that of f(q (+) d) at d = 0
// for the exponential (+), is the mean of both orders.  Everywhere else one order will do; the one
// with fewer operations is taken.
#pragma once
#include <vector>

#include "derive/coordinate.h"

namespace arboc {

using CoordinateBlock = std::vector<Coordinate>;

/// A part of the Hessian: rows are the coordinates of one block, columns those of another.
struct BlockPair {
  size_t row = 0, col = 0;
};

/// Symmetric second derivatives of `sum`, one matrix a pair; of a block with itself the upper
/// triangle.  Blocks list their coordinates in one order, say that of the joints.
/// Cost: O(coordinates * nodes of the gradient).
std::vector<SparseMatrix> hessian(Builder& builder, const WeightedSum& sum,
                                  const std::vector<CoordinateBlock>& blocks,
                                  const std::vector<BlockPair>& pairs);

/// Entry (i, j) is E_j(E_i f); full and, within groups, not symmetric.
SparseMatrix iterated_hessian(Builder& builder, const WeightedSum& sum,
                              const std::vector<Coordinate>& coordinates);

}  // namespace arboc

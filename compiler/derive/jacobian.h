// The sparse Jacobian: derivatives of several values by several coordinates.
#pragma once
#include <vector>

#include "derive/coordinate.h"

namespace arboc {

enum class Direction {
  kForward,   ///< a sweep a coordinate
  kReverse,   ///< a sweep a value
  kCheapest,  ///< both are tried and the one with fewer operations is kept
};

/// Rows are `values`, columns `coordinates`.
SparseMatrix jacobian(Builder& builder, const std::vector<Ref>& values,
                      const std::vector<Coordinate>& coordinates,
                      Direction direction = Direction::kCheapest);

}  // namespace arboc

// Reverse differentiation: one sweep gives the derivatives of one value by all coordinates.
#pragma once
#include <vector>

#include "derive/coordinate.h"

namespace arboc {

/// Derivatives of sum_i weight_i y_i by each coordinate, the weights taken as constants (a
/// vector-Jacobian product).  Cost: about twice the operations of y, O(nodes).
std::vector<Ref> gradient(Builder& builder, const WeightedSum& sum,
                          const std::vector<Coordinate>& coordinates);
std::vector<Ref> gradient(Builder& builder, Ref value, const std::vector<Coordinate>& coordinates);

}  // namespace arboc

#include "derive/jacobian.h"

#include <utility>

#include "derive/cost.h"
#include "derive/forward.h"
#include "derive/reverse.h"
#include "derive/rules.h"

namespace arboc {
namespace {

SparseMatrix forward(Builder& builder, const std::vector<Ref>& values,
                     const std::vector<Coordinate>& coordinates) {
  SparseMatrix result{
      static_cast<int>(values.size()), static_cast<int>(coordinates.size()), {}, {}, {}};
  ForwardSweep sweep(builder, values, coordinates);
  for (int j = 0; j < result.cols; ++j) {
    sweep.run(coordinates[static_cast<size_t>(j)]);
    for (int i = 0; i < result.rows; ++i) {
      const Ref x = sweep[values[static_cast<size_t>(i)]];
      if (!is_zero(builder, x)) result.push(i, j, x);
    }
  }
  return result;
}

SparseMatrix reverse(Builder& builder, const std::vector<Ref>& values,
                     const std::vector<Coordinate>& coordinates) {
  SparseMatrix result{
      static_cast<int>(values.size()), static_cast<int>(coordinates.size()), {}, {}, {}};
  std::vector<std::vector<Ref>> rows;
  for (const Ref value : values) rows.push_back(gradient(builder, value, coordinates));
  for (int j = 0; j < result.cols; ++j) {
    for (int i = 0; i < result.rows; ++i) {
      const Ref x = rows[static_cast<size_t>(i)][static_cast<size_t>(j)];
      if (!is_zero(builder, x)) result.push(i, j, x);
    }
  }
  return result;
}

/// Of the derivatives together with the values, which share what they can.
int cost(const Builder& builder, const std::vector<Ref>& values, const SparseMatrix& derivatives) {
  std::vector<Ref> roots = values;
  roots.insert(roots.end(), derivatives.value.begin(), derivatives.value.end());
  return estimated_cost(builder.region(), roots);
}

}  // namespace

SparseMatrix jacobian(Builder& builder, const std::vector<Ref>& values,
                      const std::vector<Coordinate>& coordinates, Direction direction) {
  if (direction == Direction::kForward) return forward(builder, values, coordinates);
  if (direction == Direction::kReverse) return reverse(builder, values, coordinates);
  Builder other = builder;
  SparseMatrix by_columns = forward(builder, values, coordinates);
  SparseMatrix by_rows = reverse(other, values, coordinates);
  if (cost(builder, values, by_columns) <= cost(other, values, by_rows)) return by_columns;
  builder = std::move(other);
  return by_rows;
}

}  // namespace arboc

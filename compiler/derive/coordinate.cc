#include "derive/coordinate.h"

namespace arboc {

std::vector<Coordinate> coordinates_of(Builder& builder, const std::string& name,
                                       const std::vector<Ref>& inputs) {
  std::vector<Coordinate> coordinates;
  const Ref one = builder.constant(1);
  for (const Ref input : inputs)
    coordinates.push_back({name + std::to_string(coordinates.size()), {{input, one}}, -1});
  return coordinates;
}

}  // namespace arboc

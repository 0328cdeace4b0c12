// What both directions of differentiation share: the derivative of each operation, and which nodes
// take part.
#pragma once
#include <array>
#include <vector>

#include "derive/coordinate.h"

namespace arboc {

/// The node's value changes by `factor` when that of `operand` changes by one.
struct Partial {
  Ref operand;  ///< positive
  Ref factor;
};

/// At most one entry an operand; of a x x only one: (x, 2 x).
struct Partials {
  std::array<Partial, 2> list;
  int count = 0;

  const Partial* begin() const { return list.data(); }
  const Partial* end() const { return list.data() + count; }
};

/// The derivative of each operation; the one place to extend.  Factors are shared by everything
/// that is differentiated: dividing takes one reciprocal, however many derivatives are taken.
Partials partials(Builder& builder, std::uint32_t node);

/// 1 + the largest node among `refs`.
size_t end_of(const std::vector<Ref>& refs);

/// Per node below `end`: seeded by any of the coordinates.
std::vector<char> barriers(const std::vector<Coordinate>& coordinates, size_t end);

/// Per node: `roots` depend on it by a path that no barrier blocks.
std::vector<char> needed(const Region& region, const std::vector<Ref>& roots,
                         const std::vector<char>& barrier);

inline bool is_zero(const Builder& builder, Ref ref) {
  return builder.region().is_constant(ref) && builder.region().value(ref) == 0;
}

}  // namespace arboc

// Forward differentiation: one sweep a coordinate gives the derivatives of all nodes by it.
#pragma once
#include <vector>

#include "derive/rules.h"

namespace arboc {

/// Sweeps over what `roots` need; keeps the derivatives by one coordinate at a time, so that memory
/// is that of the nodes made.
class ForwardSweep {
 public:
  /// `coordinates` is the whole requested set: all their seeds are barriers.
  ForwardSweep(Builder& builder, const std::vector<Ref>& roots,
               const std::vector<Coordinate>& coordinates);

  /// Cost: O(nodes that the roots need and that stand behind the first seed).
  void run(const Coordinate& coordinate);
  /// Derivative of a root, or of what it depends on, by the coordinate of the last run.
  Ref operator[](Ref root) const { return derivative_[root.node()].with_sign_of(root); }

 private:
  Ref change(Partial p);

  Builder& builder_;
  Ref zero_;
  std::vector<char> barrier_;
  std::vector<std::uint32_t> order_;  ///< the nodes to visit: needed, neither leaf nor barrier
  std::vector<Ref> derivative_;       ///< per node below the last root
};

}  // namespace arboc

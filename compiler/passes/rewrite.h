// What passes share: which nodes are alive, and how often and how they are used.
#pragma once
#include <vector>

#include "graph/graph.h"

namespace arboc {

/// Per node: 1 if an output of the region depends on it.
std::vector<char> alive(const Region& region);

/// How the outputs and the live nodes use each node.
struct Uses {
  std::vector<int> in_sums;        ///< as an operand of additions of the same width
  std::vector<int> elsewhere;      ///< as an operand of other nodes, or as an output
  /// Outputs that want the negated value, or lanes of it, less those that do not.
  std::vector<int> minus_outputs;
};
Uses count_uses(const Region& region);

}  // namespace arboc

// A graph as a Builder again, so that more can be made of its nodes.
#pragma once
#include <vector>

#include "graph/builder.h"

namespace arboc::test {

struct Replay {
  Builder builder;           ///< without output ports
  std::vector<Ref> inputs;   ///< entries of all input ports
  std::vector<Ref> outputs;  ///< entries of all output ports
};

/// `graph` has no n-ary sums.
Replay replay(const Graph& graph);

}  // namespace arboc::test

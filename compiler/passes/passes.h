// The passes in the order in which they run.
#pragma once
#include <array>

#include "graph/graph.h"

namespace arboc {

struct Pass {
  const char* name;
  Graph (*run)(const Graph&);
};
extern const std::array<Pass, 3> kPasses;

/// Runs all of them, verifying the graph after each; without `fused`, all but the fusing of sums.
Graph run_passes(Graph graph, bool fused = true);

}  // namespace arboc

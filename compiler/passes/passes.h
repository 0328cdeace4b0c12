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

struct PassOptions {
  bool dead = true;  ///< remove dead nodes
  bool fuse = true;  ///< fuse sums of products
};

/// Runs them, verifying the graph after each; all but those that the options leave out.
Graph run_passes(Graph graph, const PassOptions& options = {});

}  // namespace arboc

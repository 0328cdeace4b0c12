#include "passes/passes.h"

#include "passes/dead.h"
#include "passes/fuse.h"

namespace arboc {

const std::array<Pass, 3> kPasses = {{
    {"remove dead nodes", remove_dead},
    {"fuse sums of products", fuse},
    {"remove dead nodes", remove_dead},
}};

Graph run_passes(Graph graph, bool fused) {
  for (const Pass& pass : kPasses) {
    if (pass.run == fuse && !fused) continue;
    graph = pass.run(graph);
    verify(graph);
  }
  return graph;
}

}  // namespace arboc

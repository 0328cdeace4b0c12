#include "passes/passes.h"

#include "passes/dead.h"
#include "passes/fuse.h"

namespace arboc {

const std::array<Pass, 3> kPasses = {{
    {"remove dead nodes", remove_dead},
    {"fuse sums of products", fuse},
    {"remove dead nodes", remove_dead},
}};

Graph run_passes(Graph graph, const PassOptions& options) {
  for (const Pass& pass : kPasses) {
    if (pass.run == fuse ? !options.fuse : !options.dead) continue;
    graph = pass.run(graph);
    verify(graph);
  }
  return graph;
}

}  // namespace arboc

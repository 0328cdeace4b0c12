// Random graphs for the passes and the scheduler: every operation, shared and dead nodes, blocks.
//
// Values stay below 1e6: an operation whose
// result could leave the range is wrapped in a sine, divisors and radicands are at least 1.
#pragma once
#include <cstdint>
#include <vector>

#include "graph/graph.h"

namespace arboc::test {

struct RandomGraphOptions {
  int inputs = 6;  ///< in two ports
  int nodes = 120;
  int outputs = 8;  ///< in two ports
};

/// The same for the same seed and options; as tracing leaves it, without n-ary sums.
Graph random_graph(std::uint64_t seed, const RandomGraphOptions& options = {});

/// Inputs within +-1 for its ports.
std::vector<std::vector<double>> random_inputs(const Graph& graph, std::uint64_t seed);

}  // namespace arboc::test

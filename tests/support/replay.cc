#include "support/replay.h"

#include "graph/remake.h"

namespace arboc::test {

Replay replay(const Graph& graph) {
  const Region& region = graph.regions.back();
  Replay result{Builder(region.name), {}, {}};
  for (const Port& port : region.inputs)
    for (const Ref ref : result.builder.input(port.name, port.size)) result.inputs.push_back(ref);
  std::vector<Ref> made;
  const auto at = [&](Ref ref) { return made[ref.node()].with_sign_of(ref); };
  for (std::uint32_t n = 0; n < region.nodes.size(); ++n)
    made.push_back(region.nodes[n].op == Op::kInput ? result.inputs[region.nodes[n].index]
                                                    : remake(result.builder, region, n, at));
  for (const auto& port : region.results)
    for (const Ref ref : port) result.outputs.push_back(at(ref));
  return result;
}

}  // namespace arboc::test

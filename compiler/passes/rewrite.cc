#include "passes/rewrite.h"

namespace arboc {

std::vector<char> alive(const Region& region) {
  std::vector<char> live(region.nodes.size(), 0);
  for (const auto& port : region.results)
    for (const Ref ref : port) live[ref.node()] = 1;
  for (size_t n = region.nodes.size(); n-- > 0;) {
    if (live[n]) for_each_operand(region, region.nodes[n], [&](Ref ref) { live[ref.node()] = 1; });
  }
  return live;
}

Uses count_uses(const Region& region) {
  const size_t size = region.nodes.size();
  Uses uses{std::vector<int>(size), std::vector<int>(size), std::vector<int>(size)};
  const std::vector<char> live = alive(region);
  for (size_t n = 0; n < size; ++n) {
    if (!live[n]) continue;
    const Node& node = region.nodes[n];
    auto& count = node.op == Op::kAdd ? uses.in_sums : uses.elsewhere;
    for_each_operand(region, node, [&](Ref ref) { ++count[ref.node()]; });
  }
  for (const auto& port : region.results) {
    for (const Ref ref : port) {
      ++uses.elsewhere[ref.node()];
      uses.minus_outputs[ref.node()] += ref.negative() ? 1 : -1;
    }
  }
  return uses;
}

}  // namespace arboc

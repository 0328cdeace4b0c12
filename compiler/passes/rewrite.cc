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
    for_each_operand(region, node, [&](Ref ref) {
      const bool in_sum = node.op == Op::kAdd && node.width == region[ref].width;
      ++(in_sum ? uses.in_sums : uses.elsewhere)[ref.node()];
    });
  }
  for (const auto& port : region.results) {
    for (const Ref ref : port) {
      ++uses.elsewhere[ref.node()];
      const Node& node = region[ref];
      const Ref source = node.op == Op::kLane ? node.a.with_sign_of(ref) : ref;
      uses.minus_outputs[source.node()] += source.negative() ? 1 : -1;
    }
  }
  return uses;
}

}  // namespace arboc

#include "derive/forward.h"

#include <algorithm>

namespace arboc {

ForwardSweep::ForwardSweep(Builder& builder, const std::vector<Ref>& roots,
                           const std::vector<Coordinate>& coordinates)
    : builder_(builder),
      zero_(builder.constant(0)),
      barrier_(barriers(coordinates, end_of(roots))) {
  const Region& region = builder.region();
  const std::vector<char> need = needed(region, roots, barrier_);
  for (std::uint32_t n = 0; n < need.size(); ++n)
    if (need[n] && !barrier_[n] && operand_count(region.nodes[n].op) > 0) order_.push_back(n);
  derivative_.assign(need.size(), zero_);
}

void ForwardSweep::run(const Coordinate& coordinate) {
  builder_.begin_block("derivative by " + coordinate.name);
  std::fill(derivative_.begin(), derivative_.end(), zero_);
  std::uint32_t first = ~0u;
  for (const Seed& seed : coordinate.seeds) {
    const std::uint32_t n = seed.node.node();
    if (n >= derivative_.size() || is_zero(builder_, seed.derivative)) continue;
    derivative_[n] = seed.derivative.with_sign_of(seed.node);
    first = std::min(first, n);
  }
  const auto moves = [&](Ref ref) { return derivative_[ref.node()].node() != zero_.node(); };
  for (auto at = std::upper_bound(order_.begin(), order_.end(), first); at != order_.end(); ++at) {
    bool moving = false;
    const Region& region = builder_.region();
    for_each_operand(region, region.nodes[*at], [&](Ref r) { moving = moving || moves(r); });
    if (!moving) continue;
    Ref sum = zero_;
    for (const Partial& p : partials(builder_, *at))
      if (moves(p.operand)) sum = builder_.add(sum, change(p));
    derivative_[*at] = is_zero(builder_, sum) ? zero_ : sum;
  }
}

/// The constant of an operand k x goes to the factor, which all coordinates share.
Ref ForwardSweep::change(Partial p) {
  const Region& region = builder_.region();
  const Node node = region[p.operand];
  if (node.op == Op::kMul && region.is_constant(node.a) && !barrier_[p.operand.node()]) {
    p.factor = builder_.mul(node.a, p.factor);
    p.operand = node.b;
  }
  return builder_.mul(p.factor, (*this)[p.operand]);
}

}  // namespace arboc

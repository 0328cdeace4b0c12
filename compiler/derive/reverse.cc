// An adjoint is the derivative of the value by a node.  It is summed up in the order in which the
// sweep meets the users, so that nodes with the same users share the sums; what is used once
// becomes a chain of fused operations later.
#include "derive/reverse.h"

#include "derive/rules.h"

namespace arboc {
namespace {

class ReverseSweep {
 public:
  ReverseSweep(Builder& builder, const WeightedSum& sum, const std::vector<Coordinate>& coordinates)
      : builder_(builder),
        zero_(builder.constant(0)),
        barrier_(barriers(coordinates, end_of(sum.terms))),
        adjoint_(barrier_.size(), zero_) {
    find_active(sum);
    for (size_t k = 0; k < sum.terms.size(); ++k) add(sum.terms[k], sum.weights[k]);
    for (size_t n = adjoint_.size(); n-- > 0;) visit(static_cast<std::uint32_t>(n));
  }

  Ref along(const Coordinate& coordinate) {
    builder_.begin_block("derivative by " + coordinate.name);
    Ref result = zero_;
    for (const Seed& seed : coordinate.seeds) {
      const std::uint32_t n = seed.node.node();
      if (n >= adjoint_.size() || adjoint_[n] == zero_) continue;
      result =
          builder_.add(result, builder_.mul(adjoint_[n].with_sign_of(seed.node), seed.derivative));
    }
    return result;
  }

 private:
  /// Needed by the sum and dependent on a seed.
  void find_active(const WeightedSum& sum) {
    const Region& region = builder_.region();
    active_ = needed(region, sum.terms, barrier_);
    for (size_t n = 0; n < active_.size(); ++n) {
      if (barrier_[n] || !active_[n]) continue;
      char depends = 0;
      for_each_operand(region, region.nodes[n],
                       [&](Ref r) { depends = depends || active_[r.node()] ? 1 : 0; });
      active_[n] = depends;
    }
  }

  void add(Ref to, Ref amount) {
    Ref& adjoint = adjoint_[to.node()];
    if (active_[to.node()]) adjoint = builder_.add(adjoint, amount.with_sign_of(to));
  }

  void visit(std::uint32_t n) {
    if (barrier_[n] || !active_[n] || is_zero(builder_, adjoint_[n])) return;
    const Region& region = builder_.region();
    const std::uint16_t block = region.nodes[n].block;
    if (block != block_) builder_.begin_block(region.blocks[block] + ", adjoint");
    block_ = block;
    for (const Partial& p : partials(builder_, n))
      if (active_[p.operand.node()]) add(p.operand, builder_.mul(p.factor, adjoint_[n]));
  }

  Builder& builder_;
  Ref zero_;
  std::vector<char> barrier_, active_;
  std::vector<Ref> adjoint_;
  int block_ = -1;  ///< of the node visited last
};

}  // namespace

std::vector<Ref> gradient(Builder& builder, const WeightedSum& sum,
                          const std::vector<Coordinate>& coordinates) {
  ReverseSweep sweep(builder, sum, coordinates);
  std::vector<Ref> result;
  for (const Coordinate& coordinate : coordinates) result.push_back(sweep.along(coordinate));
  return result;
}

std::vector<Ref> gradient(Builder& builder, Ref value, const std::vector<Coordinate>& coordinates) {
  return gradient(builder, WeightedSum{{value}, {builder.constant(1)}}, coordinates);
}

}  // namespace arboc

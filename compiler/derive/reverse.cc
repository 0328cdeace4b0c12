// An adjoint is the derivative of the value by a node.  What its users add to it is summed up in
// the order of those nodes, so that nodes with the same users share the sums; what is used once
// becomes a chain of fused operations later.
#include "derive/reverse.h"

#include <algorithm>
#include <utility>

#include "derive/rules.h"

namespace arboc {
namespace {

class ReverseSweep {
 public:
  ReverseSweep(Builder& builder, const WeightedSum& sum, const std::vector<Coordinate>& coordinates)
      : builder_(builder),
        zero_(builder.constant(0)),
        barrier_(barriers(coordinates, end_of(sum.terms))),
        adjoint_(barrier_.size(), zero_),
        amounts_(barrier_.size()) {
    find_active(sum);
    find_slopes(coordinates);
    direct_.assign(coordinates.size(), zero_);
    for (size_t k = 0; k < sum.terms.size(); ++k) add(sum.terms[k], sum.weights[k]);
    for (size_t n = adjoint_.size(); n-- > 0;) visit(static_cast<std::uint32_t>(n));
  }

  Ref along(size_t index, const Coordinate& coordinate) {
    builder_.begin_block("derivative by " + coordinate.name);
    Ref result = direct_[index];
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

  /// The coordinate on which alone a node depends, and the derivative by it.
  struct Slope {
    int coordinate = kNone;
    Ref derivative;
  };
  static constexpr int kNone = -1, kSeveral = -2;

  void find_slopes(const std::vector<Coordinate>& coordinates) {
    slope_.resize(active_.size());
    for (size_t j = 0; j < coordinates.size(); ++j) {
      for (const Seed& seed : coordinates[j].seeds) {
        if (seed.node.node() >= slope_.size()) continue;
        Slope& slope = slope_[seed.node.node()];
        slope = {slope.coordinate == kNone ? static_cast<int>(j) : kSeveral,
                 seed.derivative.with_sign_of(seed.node)};
      }
    }
    for (std::uint32_t n = 0; n < slope_.size(); ++n)
      if (active_[n] && !barrier_[n]) slope_[n] = slope(n);
  }

  Slope slope(std::uint32_t n) {
    int of = kNone;
    for_each_operand(builder_.region(), builder_.region().nodes[n], [&](Ref r) {
      const int other = builder_.region().is_constant(r)   ? of
                        : slope_[r.node()].coordinate >= 0 ? slope_[r.node()].coordinate
                                                           : kSeveral;
      of = of == kNone ? other : of == other ? of : kSeveral;
    });
    if (of < 0) return {};
    Ref sum = zero_;
    for (const Partial& p : partials(builder_, n))
      if (const Slope& s = slope_[p.operand.node()]; s.coordinate == of)
        sum = builder_.add(sum, builder_.mul(p.factor, s.derivative));
    return {of, sum};
  }

  /// A product of a node c of one coordinate and any x.
  struct Turned {
    int coordinate = kNone;
    Ref c, x;
    Ref derivative;  ///< by the coordinate while x stays
  };

  Turned turned(Ref ref) {
    const Node node = builder_.region()[ref];
    if (node.op != Op::kMul) return {};
    Ref c = node.a, x = node.b;
    if (slope_[c.node()].coordinate < 0) std::swap(c, x);
    const Slope& of = slope_[c.node()];
    if (of.coordinate < 0 || slope_[x.node()].coordinate >= 0) return {};
    return {of.coordinate, c.with_sign_of(ref), x,
            builder_.mul(of.derivative, x).with_sign_of(ref)};
  }

  /// What node n is made of, if its derivative by a coordinate is there already.
  bool turn(std::uint32_t n) {
    const Node node = builder_.region().nodes[n];
    Turned parts[2];
    int count = 0;
    if (node.op == Op::kMul) {
      parts[count++] = turned(Ref(n));
    } else if (node.op == Op::kAdd) {
      parts[count++] = turned(node.a);
      parts[count++] = turned(node.b);
    }
    if (count == 0 || parts[0].coordinate < 0) return false;
    if (count == 2 && parts[1].coordinate != parts[0].coordinate) return false;
    Ref derivative = parts[0].derivative;
    if (count == 2) derivative = builder_.add(derivative, parts[1].derivative);
    if (derivative.node() >= active_.size() || !active_[derivative.node()]) return false;
    Ref& direct = direct_[static_cast<size_t>(parts[0].coordinate)];
    direct = builder_.add(direct, builder_.mul(derivative, adjoint_[n]));
    for (int k = 0; k < count; ++k) add(parts[k].x, builder_.mul(parts[k].c, adjoint_[n]));
    return true;
  }

  void add(Ref to, Ref amount) {
    if (active_[to.node()]) amounts_[to.node()].push_back(amount.with_sign_of(to));
  }

  /// All users have been visited.
  void sum_up(std::uint32_t n) {
    std::vector<Ref>& amounts = amounts_[n];
    std::stable_sort(amounts.begin(), amounts.end(),
                     [](Ref x, Ref y) { return x.node() < y.node(); });
    for (const Ref amount : amounts) adjoint_[n] = builder_.add(adjoint_[n], amount);
  }

  void visit(std::uint32_t n) {
    sum_up(n);
    if (barrier_[n] || !active_[n] || is_zero(builder_, adjoint_[n])) return;
    const Region& region = builder_.region();
    const std::uint16_t block = region.nodes[n].block;
    if (block != block_) builder_.begin_block(region.blocks[block] + ", adjoint");
    block_ = block;
    if (turn(n)) return;
    for (const Partial& p : partials(builder_, n))
      if (active_[p.operand.node()]) add(p.operand, builder_.mul(p.factor, adjoint_[n]));
  }

  Builder& builder_;
  Ref zero_;
  std::vector<char> barrier_, active_;
  std::vector<Slope> slope_;
  std::vector<Ref> adjoint_;
  std::vector<std::vector<Ref>> amounts_;  ///< what the users of each node add to its adjoint
  std::vector<Ref> direct_;                ///< per coordinate: what turned vectors give it
  int block_ = -1;                         ///< of the node visited last
};

}  // namespace

std::vector<Ref> gradient(Builder& builder, const WeightedSum& sum,
                          const std::vector<Coordinate>& coordinates) {
  ReverseSweep sweep(builder, sum, coordinates);
  std::vector<Ref> result;
  for (size_t j = 0; j < coordinates.size(); ++j) result.push_back(sweep.along(j, coordinates[j]));
  return result;
}

std::vector<Ref> gradient(Builder& builder, Ref value, const std::vector<Coordinate>& coordinates) {
  return gradient(builder, WeightedSum{{value}, {builder.constant(1)}}, coordinates);
}

}  // namespace arboc

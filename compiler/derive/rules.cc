#include "derive/rules.h"

#include <algorithm>
#include <stdexcept>

namespace arboc {
namespace {

Partial partial(Ref operand, Ref factor) {
  return {operand.positive(), factor.with_sign_of(operand)};
}

/// db/dw of the curvature b = (c_2 - c_3) / (4 c_1) at y = L^2 (1 - w^2) / 4, half the angle
/// squared, L the logarithm of w: dy/dw = -L.  One node a line: the order of nodes is part of the
/// result, and C++ leaves the order of arguments open.
Ref curvature_slope(Builder& builder, Ref w, Ref b) {
  const auto times = [&](double factor, Ref x) { return builder.mul(builder.constant(factor), x); };
  const Ref L = builder.quaternion_log(w);
  const Ref square = builder.mul(L, L);
  const Ref sine = builder.add(builder.constant(1), -builder.mul(w, w));
  const Ref y = times(0.25, builder.mul(square, sine));
  Ref c[6];
  for (int k = 1; k < 6; ++k) c[k] = builder.stumpff(k, y);
  const Ref direct = times(1.5, builder.add(c[4], -c[5]));
  const Ref half = times(-0.5, c[3]);
  const Ref through_b = times(2, builder.mul(b, builder.add(c[2], -c[3])));
  const Ref numerator = builder.add(direct, builder.add(half, through_b));
  const Ref slope = builder.div(numerator, times(4, c[1]));
  return -builder.mul(L, slope);
}

}  // namespace

Partials partials(Builder& builder, std::uint32_t n) {
  const Node node = builder.region().nodes[n];  // a copy: the arena grows
  const Ref self(n), a = node.a, b = node.b;
  switch (node.op) {
    case Op::kConstant:
    case Op::kInput: return {};
    case Op::kAdd: {
      const Ref one = builder.constant(1);
      return {{partial(a, one), partial(b, one)}, 2};
    }
    case Op::kMul:
      if (a == b) return {{partial(a, builder.mul(builder.constant(2), a))}, 1};
      return {{partial(a, b), partial(b, a)}, 2};
    case Op::kDiv: {
      const Ref inverse = builder.div(builder.constant(1), b);
      return {{partial(a, inverse), partial(b, -builder.mul(self, inverse))}, 2};
    }
    case Op::kSqrt: return {{partial(a, builder.div(builder.constant(0.5), self))}, 1};
    case Op::kSin: return {{partial(a, builder.cos(a))}, 1};
    case Op::kCos: return {{partial(a, -builder.sin(a))}, 1};
    case Op::kStumpff: {  // d c_k / dx = (k c_k+2 - c_k+1) / 2
      const auto k = static_cast<int>(node.index);
      const Ref next = builder.mul(builder.constant(-0.5), builder.stumpff(k + 1, a));
      if (k == 0) return {{partial(a, next)}, 1};
      const Ref second = builder.mul(builder.constant(0.5 * k), builder.stumpff(k + 2, a));
      return {{partial(a, builder.add(second, next))}, 1};
    }
    case Op::kQuaternionLog: {  // dL/dw = -2 b L^2
      const Ref b_w = builder.log_curvature(a);
      const Ref curved = builder.mul(b_w, builder.mul(self, self));
      return {{partial(a, builder.mul(builder.constant(-2), curved))}, 1};
    }
    case Op::kLogCurvature: return {{partial(a, curvature_slope(builder, a, self))}, 1};
    case Op::kPack:
    case Op::kLane:
    case Op::kHsum: throw std::logic_error("derive: the graph has lanes");
    case Op::kSum: break;
  }
  throw std::logic_error("derive: the graph has been fused already");
}

size_t end_of(const std::vector<Ref>& refs) {
  size_t end = 0;
  for (const Ref ref : refs) end = std::max(end, size_t{ref.node()} + 1);
  return end;
}

std::vector<char> barriers(const std::vector<Coordinate>& coordinates, size_t end) {
  std::vector<char> barrier(end, 0);
  for (const Coordinate& coordinate : coordinates)
    for (const Seed& seed : coordinate.seeds)
      if (seed.node.node() < end) barrier[seed.node.node()] = 1;
  return barrier;
}

std::vector<char> needed(const Region& region, const std::vector<Ref>& roots,
                         const std::vector<char>& barrier) {
  std::vector<char> need(barrier.size(), 0);
  for (const Ref root : roots) need[root.node()] = 1;
  for (size_t n = need.size(); n-- > 0;) {
    if (!need[n] || barrier[n]) continue;
    for_each_operand(region, region.nodes[n], [&](Ref operand) { need[operand.node()] = 1; });
  }
  return need;
}

}  // namespace arboc

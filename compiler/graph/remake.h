// A node of one region, made again in a builder.
#pragma once
#include <stdexcept>
#include <vector>

#include "graph/builder.h"

namespace arboc {

/// Every node but inputs and n-ary sums, which only a pass can make.  `renamed(Ref)` is what an
/// operand has become.
template <class Renamed>
Ref remake(Builder& builder, const Region& region, std::uint32_t n, const Renamed& renamed) {
  const Node& node = region.nodes[n];
  const Ref a = operand_count(node.op) > 0 ? renamed(node.a) : Ref();
  const Ref b = operand_count(node.op) > 1 ? renamed(node.b) : Ref();
  const int index = static_cast<int>(node.index);
  switch (node.op) {
    case Op::kConstant: return builder.constant(region.lanes(Ref(n)));
    case Op::kAdd: return builder.add(a, b);
    case Op::kMul: return builder.mul(a, b);
    case Op::kDiv: return builder.div(a, b);
    case Op::kSqrt: return builder.sqrt(a);
    case Op::kSin: return builder.sin(a);
    case Op::kCos: return builder.cos(a);
    case Op::kStumpff: return builder.stumpff(index, a);
    case Op::kQuaternionLog: return builder.quaternion_log(a);
    case Op::kLogCurvature: return builder.log_curvature(a);
    case Op::kPack: {
      std::vector<Ref> scalars;
      for_each_operand(region, node, [&](Ref r) { scalars.push_back(renamed(r)); });
      return builder.pack(scalars);
    }
    case Op::kLane: return builder.lane(a, index);
    case Op::kHsum: return builder.hsum(a, index);
    case Op::kInput:
    case Op::kSum: break;
  }
  throw std::logic_error("remake: an input, or a graph that has n-ary sums already");
}

}  // namespace arboc

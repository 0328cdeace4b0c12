#include "support/replay.h"

#include <stdexcept>

namespace arboc::test {
namespace {

Ref again(Builder& builder, const Region& region, const Node& node, Ref a, Ref b) {
  switch (node.op) {
    case Op::kConstant: return builder.constant(region.constants[node.index]);
    case Op::kAdd: return builder.add(a, b);
    case Op::kMul: return builder.mul(a, b);
    case Op::kDiv: return builder.div(a, b);
    case Op::kSqrt: return builder.sqrt(a);
    case Op::kSin: return builder.sin(a);
    case Op::kCos: return builder.cos(a);
    case Op::kStumpff: return builder.stumpff(static_cast<int>(node.index), a);
    case Op::kQuaternionLog: return builder.quaternion_log(a);
    case Op::kLogCurvature: return builder.log_curvature(a);
    default: throw std::logic_error("replay: fused already");
  }
}

}  // namespace

Replay replay(const Graph& graph) {
  const Region& region = graph.regions.back();
  Replay result{Builder(region.name), {}, {}};
  for (const Port& port : region.inputs)
    for (const Ref ref : result.builder.input(port.name, port.size)) result.inputs.push_back(ref);
  std::vector<Ref> made;
  const auto at = [&](Ref ref) {
    return ref.node() < made.size() ? made[ref.node()].with_sign_of(ref) : Ref();
  };
  for (const Node& node : region.nodes)
    made.push_back(node.op == Op::kInput
                       ? result.inputs[node.index]
                       : again(result.builder, region, node, at(node.a), at(node.b)));
  for (const auto& port : region.results)
    for (const Ref ref : port) result.outputs.push_back(at(ref));
  return result;
}

}  // namespace arboc::test

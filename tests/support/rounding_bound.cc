#include "support/rounding_bound.h"

#include <cmath>

namespace arboc::test {
namespace {

constexpr double kUnit = 0x1p-53;

/// What is known of one node.
struct Known {
  double value = 0;
  double error = 0;
  double magnitude = 0;  ///< of additions the sum of |terms|
  int terms = 1;         ///< of additions
};

Known known(const Region& region, const Node& node, const std::vector<Known>& all,
            const std::vector<double>& in) {
  const Known a = operand_count(node.op) > 0 ? all[node.a.node()] : Known{};
  const Known b = operand_count(node.op) > 1 ? all[node.b.node()] : Known{};
  const double x = node.a.negative() ? -a.value : a.value;
  const double y = node.b.negative() ? -b.value : b.value;
  Known k;
  switch (node.op) {
    case Op::kConstant: k.value = region.constants[node.index]; break;
    case Op::kInput: k.value = in[node.index]; break;
    case Op::kAdd:
      k.value = x + y;
      k.magnitude = a.magnitude + b.magnitude;
      k.terms = a.terms + b.terms;
      k.error = a.error + b.error + (k.terms - 1) * kUnit * k.magnitude;
      return k;
    case Op::kMul:
      k.value = x * y;
      k.error = std::fabs(x) * b.error + std::fabs(y) * a.error + a.error * b.error;
      break;
    case Op::kDiv:
      k.value = x / y;
      k.error = (a.error + std::fabs(k.value) * b.error) / (std::fabs(y) - b.error);
      break;
    case Op::kSqrt:
      k.value = std::sqrt(x);
      k.error = a.error / k.value;
      break;
    case Op::kSin:
    case Op::kCos:
      k.value = node.op == Op::kSin ? std::sin(x) : std::cos(x);
      k.error = a.error + kUnit * std::fabs(k.value);
      break;
    case Op::kStumpff:
    case Op::kQuaternionLog:
    case Op::kLogCurvature:  // of arguments where the slope is below 4
      k.value = special_value(node.op, static_cast<int>(node.index), x);
      k.error = 4 * a.error + 8 * kUnit * std::fabs(k.value);
      break;
    case Op::kPack:
    case Op::kLane:
    case Op::kHsum:
    case Op::kSum: break;  // the graph before the pass has none
  }
  k.error += operand_count(node.op) > 0 ? kUnit * std::fabs(k.value) : 0;
  k.magnitude = std::fabs(k.value);
  return k;
}

}  // namespace

std::vector<std::vector<double>> rounding_bound(const Graph& graph,
                                                const std::vector<std::vector<double>>& inputs) {
  const Region& region = graph.regions.back();
  std::vector<double> in;
  for (const auto& port : inputs) in.insert(in.end(), port.begin(), port.end());
  std::vector<Known> all;
  for (const Node& node : region.nodes) all.push_back(known(region, node, all, in));
  std::vector<std::vector<double>> bounds;
  for (const auto& port : region.results) {
    bounds.emplace_back();
    for (const Ref ref : port) bounds.back().push_back(2 * all[ref.node()].error);
  }
  return bounds;
}

}  // namespace arboc::test

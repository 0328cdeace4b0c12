// evaluate(): the meaning of a graph, node by node and lane by lane.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "graph/graph.h"

namespace arboc {
namespace {

class Evaluator {
 public:
  Evaluator(const Region& region, std::vector<double> inputs)
      : region_(region), inputs_(std::move(inputs)) {
    for (const Node& node : region.nodes)
      if (node.width > lanes_) lanes_ = node.width;
    value_.resize(region.nodes.size() * lanes_);
  }

  std::vector<std::vector<double>> run() {
    for (size_t n = 0; n < region_.nodes.size(); ++n)
      for (size_t lane = 0; lane < region_.nodes[n].width; ++lane)
        value_[n * lanes_ + lane] = value(region_.nodes[n], lane);
    std::vector<std::vector<double>> results;
    for (const auto& port : region_.results) {
      results.emplace_back();
      for (const Ref ref : port) results.back().push_back(at(ref, 0));
    }
    return results;
  }

 private:
  double at(Ref ref, size_t lane) const {
    const double v = value_[ref.node() * lanes_ + (region_[ref].width == 1 ? 0 : lane)];
    return ref.negative() ? -v : v;
  }

  double value(const Node& node, size_t lane) const {
    switch (node.op) {
      case Op::kConstant: return region_.constants[node.index + lane];
      case Op::kInput: return inputs_[node.index];
      case Op::kAdd: return at(node.a, lane) + at(node.b, lane);
      case Op::kMul: return at(node.a, lane) * at(node.b, lane);
      case Op::kDiv: return at(node.a, lane) / at(node.b, lane);
      case Op::kSqrt: return std::sqrt(at(node.a, lane));
      case Op::kSin: return std::sin(at(node.a, lane));
      case Op::kCos: return std::cos(at(node.a, lane));
      case Op::kStumpff:
      case Op::kQuaternionLog:
      case Op::kLogCurvature:
        return special_value(node.op, static_cast<int>(node.index), at(node.a, lane));
      case Op::kPack: return at(region_.terms[node.index + lane].a, 0);
      case Op::kLane: return at(node.a, node.index);
      case Op::kHsum: return horizontal_sum(node);
      case Op::kSum: return sum(node, lane);
    }
    return 0;
  }

  double sum(const Node& node, size_t lane) const {
    double v = 0;
    for (std::uint32_t t = node.index; t < node.index + node.count; ++t) {
      const Term& term = region_.terms[t];
      v = term.product ? std::fma(at(term.a, lane), at(term.b, lane), v) : v + at(term.a, lane);
    }
    return v;
  }
  /// Four by halves, as vectors do it.
  double horizontal_sum(const Node& node) const {
    if (node.index == 4) return (at(node.a, 0) + at(node.a, 2)) + (at(node.a, 1) + at(node.a, 3));
    const double low = at(node.a, 0) + at(node.a, 1);
    return node.index == 2 ? low : low + at(node.a, 2);
  }

  const Region& region_;
  std::vector<double> inputs_;
  size_t lanes_ = 1;
  std::vector<double> value_;  ///< per node and lane
};

}  // namespace

std::vector<std::vector<double>> evaluate(const Graph& graph,
                                          const std::vector<std::vector<double>>& inputs) {
  const Region& region = graph.regions.back();
  std::vector<double> in;
  for (const auto& port : inputs) in.insert(in.end(), port.begin(), port.end());
  size_t needed = 0;
  for (const Port& port : region.inputs) needed += static_cast<size_t>(port.size);
  if (in.size() != needed)
    throw std::invalid_argument(
        fmt::format("region {}: {} input values given, {} needed", region.name, in.size(), needed));
  return Evaluator(region, std::move(in)).run();
}

}  // namespace arboc

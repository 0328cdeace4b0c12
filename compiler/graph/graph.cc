#include "graph/graph.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "arboc/scalar.hpp"

namespace arboc {
namespace {

struct OpInfo {
  const char* text;
  int operands;
};
constexpr OpInfo kOps[] = {
#define ARBOC_OP(name, text, operands) {text, operands},
    ARBOC_OPS(ARBOC_OP)
#undef ARBOC_OP
};

size_t entries(const std::vector<Port>& ports) {
  size_t sum = 0;
  for (const Port& port : ports) sum += static_cast<size_t>(port.size);
  return sum;
}

void verify(const Region& region) {
  const size_t inputs = entries(region.inputs);
  const auto fail = [&](size_t n, const char* what) {
    throw std::logic_error(fmt::format("region {}, node {}: {}", region.name, n, what));
  };
  for (size_t n = 0; n < region.nodes.size(); ++n) {
    const Node& node = region.nodes[n];
    if (node.block >= region.blocks.size()) fail(n, "unknown block");
    if (node.op == Op::kSum && (node.count < 2 || node.index + node.count > region.terms.size()))
      fail(n, "bad terms");
    if (node.op == Op::kInput && node.index >= inputs) fail(n, "unknown input");
    if (node.op == Op::kStumpff && node.index > kLargestStumpff) fail(n, "unknown function");
    if (node.op == Op::kConstant) {
      if (node.index + node.count > region.constants.size()) fail(n, "bad constant");
      for (std::uint32_t i = 0; i < node.count; ++i)
        if (const double c = region.constants[node.index + i]; !std::isfinite(c) || c < 0)
          fail(n, "constant not finite and non-negative");
    }
    for_each_operand(region, node, [&](Ref ref) {
      if (ref.node() >= n) fail(n, "operand behind its user");
    });
  }
  if (region.results.size() != region.outputs.size())
    throw std::logic_error(fmt::format("region {}: outputs without results", region.name));
  for (size_t p = 0; p < region.results.size(); ++p) {
    if (region.results[p].size() != static_cast<size_t>(region.outputs[p].size))
      throw std::logic_error(
          fmt::format("region {}: output {} has the wrong size", region.name, p));
    for (const Ref ref : region.results[p])
      if (ref.node() >= region.nodes.size())
        throw std::logic_error(fmt::format("region {}: result out of range", region.name));
  }
}

template <int... k>
double stumpff_of(int which, double x, std::integer_sequence<int, k...> /*all*/) {
  double value = 0;
  static_cast<void>(((which == k && (value = stumpff<k>(x), true)) || ...));
  return value;
}

}  // namespace

double special_value(Op op, int k, double x) {
  if (op == Op::kQuaternionLog) return quaternion_log(x);
  if (op == Op::kLogCurvature) return log_curvature(x);
  return stumpff_of(k, x, std::make_integer_sequence<int, kLargestStumpff + 1>());
}

int operand_count(Op op) { return kOps[static_cast<size_t>(op)].operands; }
const char* spelling(Op op) { return kOps[static_cast<size_t>(op)].text; }

void verify(const Graph& graph) {
  if (graph.regions.empty()) throw std::logic_error("graph without a region");
  for (const Region& region : graph.regions) verify(region);
}

std::vector<std::vector<double>> evaluate(const Graph& graph,
                                          const std::vector<std::vector<double>>& inputs) {
  const Region& region = graph.regions.back();
  std::vector<double> in;
  for (const auto& port : inputs) in.insert(in.end(), port.begin(), port.end());
  if (in.size() != entries(region.inputs))
    throw std::invalid_argument(fmt::format("region {}: {} input values given, {} needed",
                                            region.name, in.size(), entries(region.inputs)));

  std::vector<double> value(region.nodes.size());
  const auto at = [&](Ref ref) { return ref.negative() ? -value[ref.node()] : value[ref.node()]; };
  for (size_t n = 0; n < region.nodes.size(); ++n) {
    const Node& node = region.nodes[n];
    double& v = value[n];
    switch (node.op) {
      case Op::kConstant: v = region.constants[node.index]; break;
      case Op::kInput: v = in[node.index]; break;
      case Op::kAdd: v = at(node.a) + at(node.b); break;
      case Op::kMul: v = at(node.a) * at(node.b); break;
      case Op::kDiv: v = at(node.a) / at(node.b); break;
      case Op::kSqrt: v = std::sqrt(at(node.a)); break;
      case Op::kSin: v = std::sin(at(node.a)); break;
      case Op::kCos: v = std::cos(at(node.a)); break;
      case Op::kStumpff:
      case Op::kQuaternionLog:
      case Op::kLogCurvature:
        v = special_value(node.op, static_cast<int>(node.index), at(node.a));
        break;
      case Op::kSum:
        v = 0;
        for (std::uint32_t t = node.index; t < node.index + node.count; ++t) {
          const Term& term = region.terms[t];
          v = term.product ? std::fma(at(term.a), at(term.b), v) : v + at(term.a);
        }
        break;
    }
  }
  std::vector<std::vector<double>> results;
  for (const auto& port : region.results) {
    results.emplace_back();
    for (const Ref ref : port) results.back().push_back(at(ref));
  }
  return results;
}

}  // namespace arboc

#include "graph/graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "arboc/scalar.hpp"

namespace arboc {
namespace {

constexpr const char* kSpellings[] = {
#define ARBOC_OP(name, text, operands) text,
    ARBOC_OPS(ARBOC_OP)
#undef ARBOC_OP
};

size_t entries(const std::vector<Port>& ports) {
  size_t sum = 0;
  for (const Port& port : ports) sum += static_cast<size_t>(port.size);
  return sum;
}

bool is_listed(Op op) { return op == Op::kSum || op == Op::kPack; }

const char* fault_of_constant(const Region& region, const Node& node) {
  if (node.count < 1 || node.count > kMostLanes ||
      node.index + node.count > region.constants.size())
    return "bad constant";
  const double* x = region.constants.data() + node.index;
  const double* const end = x + node.count;
  if (!std::all_of(x, end, [](double c) { return std::isfinite(c); }))
    return "constant not finite and non-negative";
  const double* const first = std::find_if(x, end, [](double c) { return c != 0; });
  if (first != end && *first < 0) return "constant not finite and non-negative";
  if (node.count > 1 && std::all_of(x, end, [x](double c) { return c == *x; }))
    return "lanes of a constant all the same";
  return nullptr;
}

const char* fault_of_width(const Region& region, const Node& node) {
  if (node.op == Op::kPack && (node.count < 2 || node.count > kMostLanes)) return "bad pack";
  if (node.width != width_of(region, node)) return "wrong width";
  bool scalars = true;
  for_each_operand(region, node, [&](Ref ref) { scalars = scalars && region[ref].width == 1; });
  if (node.op == Op::kPack && !scalars) return "pack of lanes";
  if (node.op != Op::kLane && node.op != Op::kHsum) return nullptr;
  const std::uint32_t lanes = region[node.a].width, least = node.op == Op::kHsum ? 2 : 0;
  if (lanes < 2 || node.index < least || node.index + 1 > lanes + least / 2) return "unknown lane";
  return nullptr;
}

void verify(const Region& region) {
  const size_t inputs = entries(region.inputs);
  const auto fail = [&](size_t n, const char* what) {
    throw std::logic_error(fmt::format("region {}, node {}: {}", region.name, n, what));
  };
  for (size_t n = 0; n < region.nodes.size(); ++n) {
    const Node& node = region.nodes[n];
    if (node.block >= region.blocks.size()) fail(n, "unknown block");
    if (is_listed(node.op) && (node.count < 2 || node.index + node.count > region.terms.size()))
      fail(n, "bad terms");
    if (node.op == Op::kInput && node.index >= inputs) fail(n, "unknown input");
    if (node.op == Op::kStumpff && node.index > kLargestStumpff) fail(n, "unknown function");
    if (node.op == Op::kConstant)
      if (const char* fault = fault_of_constant(region, node)) fail(n, fault);
    for_each_operand(region, node, [&](Ref ref) {
      if (ref.node() >= n) fail(n, "operand behind its user");
    });
    if (const char* fault = fault_of_width(region, node)) fail(n, fault);
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
    for (const Ref ref : region.results[p])
      if (region[ref].width != 1)
        throw std::logic_error(fmt::format("region {}: result in lanes", region.name));
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

int width_of(const Region& region, const Node& node) {
  if (node.op == Op::kConstant) return static_cast<int>(node.count);
  if (node.op == Op::kPack) return static_cast<int>(node.count);
  int width = 1;
  for_each_operand(region, node, [&](Ref ref) {
    const int own = region[ref].width;
    if (own != 1) width = width == 1 || width == own ? own : 0;
  });
  const bool narrows = node.op == Op::kLane || node.op == Op::kHsum;
  return narrows && width > 1 ? 1 : width;
}

Lanes Region::lanes(Ref ref) const {
  const Node& node = nodes[ref.node()];
  Lanes lanes;
  lanes.width = node.width;
  for (int k = 0; k < lanes.width; ++k) {
    const double v = constants[node.index + static_cast<size_t>(k)];
    lanes.x[k] = ref.negative() ? -v : v;
  }
  return lanes;
}

const char* spelling(Op op) { return kSpellings[static_cast<size_t>(op)]; }

void verify(const Graph& graph) {
  if (graph.regions.empty()) throw std::logic_error("graph without a region");
  for (const Region& region : graph.regions) verify(region);
}

}  // namespace arboc

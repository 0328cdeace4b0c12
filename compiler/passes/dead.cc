#include "passes/dead.h"

#include "passes/rewrite.h"

namespace arboc {
namespace {

Region remove_dead(const Region& region) {
  const std::vector<char> live = alive(region);
  Region out;
  out.name = region.name;
  out.inputs = region.inputs;
  out.outputs = region.outputs;
  out.blocks = region.blocks;
  std::vector<std::uint32_t> renamed(region.nodes.size());
  const auto rename = [&](Ref ref) { return Ref(renamed[ref.node()], ref.negative()); };

  for (size_t n = 0; n < region.nodes.size(); ++n) {
    Node node = region.nodes[n];
    if (!live[n] && node.op != Op::kInput) continue;
    renamed[n] = static_cast<std::uint32_t>(out.nodes.size());
    if (operand_count(node.op) > 0) node.a = rename(node.a);
    if (operand_count(node.op) > 1) node.b = rename(node.b);
    if (node.op == Op::kConstant) {
      const auto first = region.constants.begin() + node.index;
      node.index = static_cast<std::uint32_t>(out.constants.size());
      out.constants.insert(out.constants.end(), first, first + node.count);
    }
    if (node.op == Op::kSum || node.op == Op::kPack) {
      const std::uint32_t first = node.index;
      node.index = static_cast<std::uint32_t>(out.terms.size());
      for (std::uint32_t t = first; t < first + node.count; ++t) {
        Term term = region.terms[t];
        term.a = rename(term.a);
        if (term.product) term.b = rename(term.b);
        out.terms.push_back(term);
      }
    }
    out.nodes.push_back(node);
  }
  for (const auto& port : region.results) {
    out.results.emplace_back();
    for (const Ref ref : port) out.results.back().push_back(rename(ref));
  }
  return out;
}

}  // namespace

Graph remove_dead(const Graph& graph) {
  Graph out;
  for (const Region& region : graph.regions) out.regions.push_back(remove_dead(region));
  return out;
}

}  // namespace arboc

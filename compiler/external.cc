#include "external.h"

#include <algorithm>
#include <utility>

#include "derive/jacobian.h"
#include "functions/catalogue.h"
#include "graph/remake.h"
#include "passes/passes.h"

namespace arboc {
namespace {

/// An output as a sparse matrix, from the order in which functions have their entries.
SparseMatrix whole(const Argument& a, const Pattern& pattern, const std::vector<Ref>& entries) {
  struct Entry {
    int col, row;
    Ref value;
  };
  std::vector<Entry> list;
  for (size_t k = 0; k < entries.size(); ++k) {
    const int n = static_cast<int>(k);
    const int row = a.sparse ? pattern.row[k] : n / a.cols;
    const int col = a.sparse ? pattern.col[k] : n % a.cols;
    list.push_back({col, row, entries[k]});
    if (a.symmetric && row != col) list.push_back({row, col, entries[k]});
  }
  std::sort(list.begin(), list.end(), [](const Entry& x, const Entry& y) {
    return std::pair(x.col, x.row) < std::pair(y.col, y.row);
  });
  SparseMatrix matrix{a.rows, a.cols, {}, {}, {}};
  for (const Entry& entry : list) matrix.push(entry.row, entry.col, entry.value);
  return matrix;
}

/// What is known of a function on the way to C.
struct Draft {
  Graph graph;
  std::vector<Pattern> patterns;
};

/// Outputs whole and by columns; those behind the signature's, which are checked, as they are.
Draft by_columns(Traced traced, const Signature& s) {
  Draft out{std::move(traced.graph), {}};
  Region& region = out.graph.regions.back();
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    SparseMatrix matrix = whole(s.outputs[k], traced.patterns[k], region.results[k]);
    region.outputs[k].size = static_cast<int>(matrix.value.size());
    region.results[k] = std::move(matrix.value);
    out.patterns.push_back({std::move(matrix.row), std::move(matrix.col)});
  }
  return out;
}

/// The nodes of a finished graph once more, to add to them.
class Replay {
 public:
  Replay(const Region& region, Builder& builder) {
    for (const Port& port : region.inputs) inputs.push_back(builder.input(port.name, port.size));
    std::vector<Ref> entries;
    for (const auto& input : inputs) entries.insert(entries.end(), input.begin(), input.end());
    std::uint16_t block = 0;
    for (std::uint32_t n = 0; n < region.nodes.size(); ++n) {
      const Node& node = region.nodes[n];
      if (node.block != block) builder.begin_block(region.blocks[block = node.block]);
      made_.push_back(node.op == Op::kInput
                          ? entries[node.index]
                          : remake(builder, region, n, [&](Ref r) { return (*this)[r]; }));
    }
  }
  Ref operator[](Ref ref) const { return ref.negative() ? -made_[ref.node()] : made_[ref.node()]; }

  std::vector<std::vector<Ref>> inputs;

 private:
  std::vector<Ref> made_;
};

/// The Jacobian of all outputs by all inputs, on the graph.
Draft differentiated(const Draft& function, const Signature& s) {
  const Region& region = function.graph.regions.back();
  Builder builder("jac_" + s.name);
  const Replay replay(region, builder);
  std::vector<Ref> values;
  std::vector<std::pair<size_t, int>> row_of;  ///< output, and which of its entries
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    for (size_t e = 0; e < region.results[k].size(); ++e) {
      values.push_back(replay[region.results[k][e]]);
      const Pattern& pattern = function.patterns[k];
      row_of.emplace_back(k, pattern.col[e] * s.outputs[k].rows + pattern.row[e]);
    }
  }
  std::vector<Coordinate> coordinates;
  std::vector<std::pair<size_t, int>> column_of;
  for (size_t i = 0; i < replay.inputs.size(); ++i) {
    for (size_t e = 0; e < replay.inputs[i].size(); ++e)
      column_of.emplace_back(i, static_cast<int>(e));
    for (Coordinate& c : coordinates_of(builder, region.inputs[i].name, replay.inputs[i]))
      coordinates.push_back(std::move(c));
  }
  const SparseMatrix J = jacobian(builder, values, coordinates);
  std::vector<SparseMatrix> blocks(s.outputs.size() * s.inputs.size());
  for (size_t k = 0; k < J.value.size(); ++k) {
    const auto [output, row] = row_of[static_cast<size_t>(J.row[k])];
    const auto [input, col] = column_of[static_cast<size_t>(J.col[k])];
    blocks[output * s.inputs.size() + input].push(row, col, J.value[k]);
  }
  Draft out;
  for (size_t k = 0; k < blocks.size(); ++k) {
    const Argument& y = s.outputs[k / s.inputs.size()];
    builder.output("jac_" + y.name + "_" + s.inputs[k % s.inputs.size()].name, blocks[k].value);
    out.patterns.push_back({blocks[k].row, blocks[k].col});
  }
  if (!s.positive.empty()) {
    std::vector<Ref> checked;
    for (const Ref ref : region.results.back()) checked.push_back(replay[ref]);
    builder.output(s.positive, checked);
  }
  out.graph = std::move(builder).finish();
  return out;
}

/// Each coordinate of a configuration is a number by itself, whose rate is an entry of v.
bool plain(const Model& model) {
  return std::all_of(model.joints.begin(), model.joints.end(), [](const Joint& joint) {
    return nv(joint) == 0 || (nv(joint) == 1 && nq(joint) == 1);
  });
}

/// The function of the catalogue that has the Jacobian's blocks as its outputs, or "": a recursion
/// needs fewer operations than derivatives on the graph.
std::string recursion(const Request& request, const Signature& s, const Setup& setup) {
  const std::string name = request.function + "_derivatives";
  const std::vector<std::string> known = function_names();
  if (request.derivative != Derivative::kNone || s.outputs.size() != 1 || !plain(setup.model) ||
      s.outputs[0].cols != 1 || std::find(known.begin(), known.end(), name) == known.end())
    return "";
  return signature({name}, setup).outputs.size() == s.inputs.size() ? name : "";
}

/// Inputs: those of the function and its outputs; outputs: a block for each pair.
Signature jacobian_signature(const Signature& s) {
  Signature jacobian;
  jacobian.name = "jac_" + s.name;
  jacobian.meaning = "Jacobian of " + s.name + ": each output by each input.";
  jacobian.positive = s.positive;
  jacobian.inputs = s.inputs;
  for (const Argument& y : s.outputs) {
    jacobian.inputs.push_back(y);
    jacobian.inputs.back().name = "out_" + y.name;
    jacobian.inputs.back().meaning = "not looked at";
    for (const Argument& x : s.inputs) {
      Argument block;
      block.name = "jac_" + y.name + "_" + x.name;
      block.rows = y.rows * y.cols;
      block.cols = x.rows * x.cols;
      block.sparse = true;
      block.unit = "(" + y.unit + ") / (" + x.unit + ")";
      block.meaning = "derivative of " + y.name + " with respect to the entries of " + x.name;
      jacobian.outputs.push_back(block);
    }
  }
  return jacobian;
}

void keep_smaller(ExternalFunction& best, bool first, Draft draft, const Setup& setup) {
  const PassOptions passes{setup.simplify.dead, setup.simplify.fuse};
  Program program = schedule(run_passes(std::move(draft.graph), passes), {setup.max_function_size});
  if (!first && program.ops.total() >= best.program.ops.total()) return;
  best.program = std::move(program);
  best.patterns = std::move(draft.patterns);
}

bool is_derivative(const Request& request) {
  return defined_as(request).derivative != Derivative::kNone ||
         request.function.ends_with("_derivatives");
}

}  // namespace

std::vector<ExternalFunction> external_functions(const Request& request, const Setup& setup) {
  const Signature s = signature(request, setup);
  std::vector<ExternalFunction> out(is_derivative(request) ? 1 : 2);
  for (ExternalFunction& f : out) f.name = s.name;
  out[0].signature = s;
  const std::string by_recursion = out.size() > 1 ? recursion(request, s, setup) : "";
  if (out.size() > 1) {
    out[1].jacobian = true;
    out[1].signature = jacobian_signature(s);
  }
  bool first = true;
  for (LoweringOptions lowering : lowerings(request.function)) {
    if (!first && !setup.simplify.frames) break;
    lowering.regroup = lowering.regroup && setup.simplify.regroup;
    const Draft function = by_columns(trace(request, setup, lowering), s);
    if (out.size() > 1) {
      Draft jacobian = by_recursion.empty() ? differentiated(function, s)
                                            : by_columns(trace({by_recursion}, setup, lowering),
                                                         signature({by_recursion}, setup));
      keep_smaller(out[1], first, std::move(jacobian), setup);
    }
    keep_smaller(out[0], first, function, setup);
    first = false;
  }
  return out;
}

}  // namespace arboc

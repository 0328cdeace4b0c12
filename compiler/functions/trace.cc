#include "functions/trace.h"

#include <utility>

#include "derive/coordinate.h"
#include "derive/hessian.h"
#include "derive/jacobian.h"
#include "derive/reverse.h"
#include "functions/cheaper.h"
#include "functions/derived_signature.h"
#include "functions/recursion.h"
#include "functions/refuse.h"
#include "functions/run.h"
#include "functions/symbolic_tree.h"
#include "functions/tangent.h"
#include "graph/canonical.h"

namespace arboc {
namespace {

/// A trace on its way: inputs, and outputs by name.
class Tracer {
 public:
  Tracer(const Request& request, const Setup& setup, const LoweringOptions& lowering)
      : setup_(setup),
        lowering_(lowering),
        nominal_(lower(setup, lowering)),
        signature_(signature(request, setup)),
        request_(defined_as(request)),
        builder_(signature_.name) {}

  /// A Jacobian by `recursion` if there is one, otherwise on the graph of what it is of.
  Traced run(const JacobianRecursion* recursion = nullptr) {
    for (const Argument& a : signature_.inputs)
      for (const Ref ref : builder_.input(a.name, a.rows * a.cols))
        inputs_[a.name].emplace_back(&builder_, ref);
    if (request_.derivative == Derivative::kNone)
      plain();
    else if (recursion)
      recursive(*recursion);
    else
      derived();
    if (!pivots_.empty()) output(signature_.positive, pivots_);
    Traced traced;
    traced.patterns = std::move(patterns_);
    traced.graph = std::move(builder_).finish();
    return traced;
  }

 private:
  /// Results of a function of the catalogue; keeps its pivots.  Inputs that there are not are zero.
  std::vector<std::vector<Expr>> evaluate(const Signature& s, const Setup& setup) {
    refuse_massless(nominal_, setup, s.name);
    refuse_dynamics(setup.model, s.name);
    Arguments<Expr> inputs = inputs_;
    for (const Argument& a : s.inputs)
      inputs.try_emplace(a.name, static_cast<size_t>(a.rows), Expr(0));
    std::vector<std::vector<Expr>> results =
        setup.parameters.empty()
            ? arboc::run(s, nominal_, setup, inputs)
            : arboc::run(s, symbolic_tree(setup, lowering_, nominal_, inputs), setup, inputs);
    if (!s.positive.empty()) {
      pivots_ = std::move(results.back());
      results.pop_back();
      refuse_singular(nominal_, pivots_, s.name);
    }
    return results;
  }

  /// Puts what was traced into an order that does not depend on the compiler of this program.
  void settle(NodeOrder order, std::vector<std::vector<Expr>>& results,
              std::vector<CoordinateBlock>& blocks) {
    std::vector<Ref> roots;
    const auto each = [&](auto&& visit) {
      for (auto& [name, input] : inputs_)
        for (Expr& x : input) visit(x);
      for (auto& result : results)
        for (Expr& x : result) visit(x);
      for (Expr& x : pivots_) visit(x);
    };
    each([&](Expr& x) { roots.push_back(x.ref(builder_)); });
    for (CoordinateBlock& block : blocks)
      for (Coordinate& c : block)
        for (Seed& s : c.seeds) roots.insert(roots.end(), {s.node, s.derivative});
    roots = canonicalise(builder_, roots, order);
    auto next = roots.begin();
    each([&](Expr& x) { x = Expr(&builder_, *next++); });
    for (CoordinateBlock& block : blocks)
      for (Coordinate& c : block)
        for (Seed& s : c.seeds) {
          s.node = *next++;
          s.derivative = *next++;
        }
  }

  void plain() {
    std::vector<std::vector<Expr>> results = evaluate(signature_, setup_);
    std::vector<CoordinateBlock> none;
    settle(NodeOrder::kByCones, results, none);
    for (size_t k = 0; k < results.size(); ++k) dense(signature_.outputs[k], results[k]);
  }

  /// Of a matrix that is sparse the structural non-zeros.
  void dense(const Argument& a, const std::vector<Expr>& values) {
    Pattern& pattern = patterns_.emplace_back();
    output(a.code(), a.sparse ? non_zeros(a, values, pattern) : values);
  }

  /// Of what derivatives are taken.
  Signature base() const { return signature(Request{request_.function}, setup_); }

  void derived() {
    const Signature s = base();
    std::vector<std::vector<Expr>> results = evaluate(s, setup_);
    const std::vector<std::string> with = derived_inputs(request_, s);
    std::vector<CoordinateBlock> blocks;
    for (const std::string& input : with) blocks.push_back(coordinates(input));
    settle(NodeOrder::kByLevels, results, blocks);
    const size_t k = output_index(s, request_.output);
    std::vector<Ref> values;
    for (const Expr& x : filled(s.outputs[k], results[k])) values.push_back(x.ref(builder_));
    if (request_.derivative == Derivative::kJacobian)
      jacobians(values, blocks);
    else if (request_.derivative == Derivative::kHessian)
      hessians(weighted(values), with, blocks);
    else
      gradients(weighted(values), blocks);
  }

  void recursive(const JacobianRecursion& recursion) {
    const std::vector<std::string> with = derived_inputs(request_, base());
    const Signature s = signature(Request{recursion.function}, setup_);
    std::vector<std::vector<Expr>> all, columns;
    for (const std::string& input : with) {
      if (input == "f_ext") {
        columns.push_back(by_wrenches());
        continue;
      }
      if (all.empty()) all = evaluate(s, setup_);
      const size_t k = output_index(s, recursion.output(input));
      columns.push_back(filled(s.outputs[k], all[k]));
    }
    std::vector<CoordinateBlock> none;
    settle(NodeOrder::kByCones, columns, none);
    for (size_t w = 0; w < with.size(); ++w) dense(signature_.outputs[w], columns[w]);
  }

  /// Of inverse dynamics by wrenches: -J^T of the loaded frames.
  std::vector<Expr> by_wrenches() {
    Setup loaded = setup_;
    loaded.frames = setup_.loads;
    const Signature s = signature(Request{"frame_jacobian"}, loaded);
    const std::vector<Expr> J = std::move(evaluate(s, loaded)[0]);
    const auto rows = static_cast<size_t>(s.outputs[0].rows), n = J.size() / rows;
    std::vector<Expr> columns(J.size());
    for (size_t i = 0; i < n; ++i)
      for (size_t k = 0; k < rows; ++k) columns[i * rows + k] = -J[k * n + i];
    return columns;
  }

  /// Both triangles of a symmetric matrix.
  static std::vector<Expr> filled(const Argument& a, std::vector<Expr> values) {
    const auto n = static_cast<size_t>(a.rows);
    for (size_t i = 0; a.symmetric && i < n; ++i)
      for (size_t j = 0; j < i; ++j) values[i * n + j] = values[j * n + i];
    return values;
  }

  /// What a scalar derivative is taken of: the value, y^T y / 1, or lambda^T y.
  WeightedSum weighted(const std::vector<Ref>& values) {
    if (request_.squares) {
      Ref sum = builder_.constant(0);
      for (const Ref y : values) sum = builder_.add(sum, builder_.mul(y, y));
      return {{sum}, {builder_.constant(1)}};
    }
    const auto lambda = inputs_.find("lambda");
    if (lambda == inputs_.end()) return {values, {builder_.constant(1)}};
    WeightedSum sum{values, {}};
    for (const Expr& x : lambda->second) sum.weights.push_back(x.ref(builder_));
    return sum;
  }

  std::vector<Coordinate> coordinates(const std::string& input) {
    std::vector<Ref> refs;
    for (const Expr& x : inputs_.at(input)) refs.push_back(x.ref(builder_));
    if (input == "q" || input == "q1") return tangent(nominal_, builder_, refs);
    return coordinates_of(builder_, input, refs);
  }

  /// Those of several inputs in one list; `first` receives where each begins, and the end.
  static std::vector<Coordinate> all_coordinates(const std::vector<CoordinateBlock>& blocks,
                                                 std::vector<int>& first) {
    std::vector<Coordinate> all;
    for (const CoordinateBlock& block : blocks) {
      first.push_back(static_cast<int>(all.size()));
      all.insert(all.end(), block.begin(), block.end());
    }
    first.push_back(static_cast<int>(all.size()));
    return all;
  }

  void jacobians(const std::vector<Ref>& values, const std::vector<CoordinateBlock>& with) {
    std::vector<int> first;
    const std::vector<Coordinate> all = all_coordinates(with, first);
    const SparseMatrix J = jacobian(builder_, values, all);
    for (size_t w = 0; w < with.size(); ++w)
      output(signature_.outputs[w].name, J.part(0, J.rows, first[w], first[w + 1]));
  }

  void gradients(const WeightedSum& sum, const std::vector<CoordinateBlock>& with) {
    std::vector<int> first;
    const std::vector<Coordinate> all = all_coordinates(with, first);
    const std::vector<Ref> g = gradient(builder_, sum, all);
    for (size_t w = 0; w < with.size(); ++w) {
      builder_.output(signature_.outputs[w].name, {g.begin() + first[w], g.begin() + first[w + 1]});
      patterns_.emplace_back();
    }
  }

  /// The pair of inputs behind an output H_qv.
  BlockPair pair(const std::string& output, const std::vector<std::string>& with) const {
    for (size_t i = 0; i < with.size(); ++i)
      for (size_t j = 0; j < with.size(); ++j)
        if (output == "H_" + with[i] + with[j]) return {i, j};
    throw std::logic_error("no block " + output);
  }

  void hessians(const WeightedSum& sum, const std::vector<std::string>& with,
                const std::vector<CoordinateBlock>& blocks) {
    std::vector<BlockPair> pairs;
    for (const Argument& a : signature_.outputs) pairs.push_back(pair(a.name, with));
    if (!setup_.iterated) {
      const std::vector<SparseMatrix> H = hessian(builder_, sum, blocks, pairs);
      for (size_t k = 0; k < pairs.size(); ++k) output(signature_.outputs[k].name, H[k]);
      return;
    }
    std::vector<int> first;
    const SparseMatrix H = iterated_hessian(builder_, sum, all_coordinates(blocks, first));
    for (size_t p = 0; p < pairs.size(); ++p) {
      const auto [r, c] = pairs[p];
      output(signature_.outputs[p].name, H.part(first[r], first[r + 1], first[c], first[c + 1]));
    }
  }

  /// The structural non-zeros of an output, by columns, and their values.
  static std::vector<Expr> non_zeros(const Argument& a, const std::vector<Expr>& matrix,
                                     Pattern& pattern) {
    std::vector<Expr> entries;
    for (int col = 0; col < a.cols; ++col) {
      for (int row = 0; row < (a.symmetric ? col + 1 : a.rows); ++row) {
        const Expr& entry = matrix[static_cast<size_t>(row) * static_cast<size_t>(a.cols) +
                                   static_cast<size_t>(col)];
        if (is_zero(entry)) continue;
        pattern.row.push_back(row);
        pattern.col.push_back(col);
        entries.push_back(entry);
      }
    }
    return entries;
  }

  void output(const std::string& name, const std::vector<Expr>& values) {
    std::vector<Ref> refs;
    for (const Expr& value : values) refs.push_back(value.ref(builder_));
    builder_.output(name, refs);
  }
  void output(const std::string& name, const SparseMatrix& matrix) {
    builder_.output(name, matrix.value);
    patterns_.push_back({matrix.row, matrix.col});
  }

  const Setup& setup_;
  LoweringOptions lowering_;
  DynamicTree nominal_;
  Signature signature_;
  Request request_;  ///< definitions resolved
  Builder builder_;
  Arguments<Expr> inputs_;
  std::vector<Expr> pivots_;
  std::vector<Pattern> patterns_;
};

}  // namespace

Traced trace(const Request& request, const Setup& setup, const LoweringOptions& lowering) {
  Traced on_graph = Tracer(request, setup, lowering).run();
  const JacobianRecursion* recursion = recursion_of(request, setup);
  if (!recursion) return on_graph;
  return cheaper(std::move(on_graph), Tracer(request, setup, lowering).run(recursion));
}

}  // namespace arboc

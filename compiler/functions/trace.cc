#include "functions/trace.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/diagnostic.h"
#include "derive/coordinate.h"
#include "derive/hessian.h"
#include "derive/jacobian.h"
#include "derive/reverse.h"
#include "functions/derived_signature.h"
#include "functions/run.h"
#include "functions/symbolic_tree.h"
#include "functions/tangent.h"
#include "graph/canonical.h"

namespace arboc {
namespace {

/// Names the joint whose coordinate can never be accelerated by a finite force.
void refuse_singular(const DynamicTree& tree, const std::vector<Expr>& pivots,
                     const std::string& function) {
  for (size_t k = pivots.size(); k-- > 0;) {
    if (!pivots[k].is_constant() || pivots[k].value() > 0) continue;
    const auto body = std::find_if(tree.body.begin(), tree.body.end(), [&](const Body& b) {
      const int first = b.v, last = b.v + freedoms(b.motion);
      return first <= static_cast<int>(k) && static_cast<int>(k) < last;
    });
    throw AbsentError(
        fmt::format("error: joint '{}': what it moves has no inertia about its axis, so {} has no "
                    "solution (give its links mass, fix the joint, or leave {} out)",
                    printable(body->joint), function, function));
  }
}

/// Functions of the centre of mass divide by the mass of what moves.
void refuse_massless(const DynamicTree& tree, const Setup& setup, const std::string& function) {
  if (function != "com" && function != "com_jacobian" && function != "centroidal") return;
  for (const Parameter& p : setup.parameters)
    if (p.kind == Parameter::Kind::kMass) return;
  if (total_mass<double>(tree) == 0)
    throw AbsentError(fmt::format(
        "error: nothing that moves has mass, so {} has no value (give links mass, or leave {} out)",
        function, function));
}

/// Of a file without masses there is kinematics only.
void refuse_dynamics(const Model& model, const std::string& function) {
  constexpr const char* kKinematic[] = {"fk",        "frame_",     "joint_jacobians",
                                        "integrate", "difference", "regressor"};
  if (!model.kinematic) return;
  for (const char* name : kKinematic)
    if (function.starts_with(name)) return;
  throw AbsentError(fmt::format(
      "error: the file gives no mass, cg and inertia of anything, so there is no {} (give them, or "
      "ask for fk, frame_jacobian and the like)",
      function));
}

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

  Traced run() {
    for (const Argument& a : signature_.inputs)
      for (const Ref ref : builder_.input(a.name, a.rows * a.cols))
        inputs_[a.name].emplace_back(&builder_, ref);
    if (request_.derivative == Derivative::kNone)
      plain();
    else
      derived();
    if (!pivots_.empty()) output(signature_.positive, pivots_);
    Traced traced;
    traced.patterns = std::move(patterns_);
    traced.graph = std::move(builder_).finish();
    return traced;
  }

 private:
  /// Results of a function of the catalogue; keeps its pivots.
  std::vector<std::vector<Expr>> evaluate(const Signature& s) {
    refuse_massless(nominal_, setup_, s.name);
    refuse_dynamics(setup_.model, s.name);
    std::vector<std::vector<Expr>> results =
        setup_.parameters.empty()
            ? arboc::run(s, nominal_, setup_, inputs_)
            : arboc::run(s, symbolic_tree(setup_, lowering_, nominal_, inputs_), setup_, inputs_);
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
    std::vector<std::vector<Expr>> results = evaluate(signature_);
    std::vector<CoordinateBlock> none;
    settle(NodeOrder::kByCones, results, none);
    for (size_t k = 0; k < results.size(); ++k) {
      const Argument& a = signature_.outputs[k];
      Pattern& pattern = patterns_.emplace_back();
      output(a.code(), a.sparse ? non_zeros(a, results[k], pattern) : results[k]);
    }
  }

  void derived() {
    Request base;
    base.function = request_.function;
    const Signature s = signature(base, setup_);
    std::vector<std::vector<Expr>> results = evaluate(s);
    const std::vector<std::string> with = derived_inputs(request_, s);
    std::vector<CoordinateBlock> blocks;
    for (const std::string& input : with) blocks.push_back(coordinates(input));
    settle(NodeOrder::kByLevels, results, blocks);
    size_t k = 0;
    while (s.outputs[k].name != request_.output) ++k;
    std::vector<Ref> values;
    for (const Expr& x : filled(s.outputs[k], results[k])) values.push_back(x.ref(builder_));
    if (request_.derivative == Derivative::kJacobian)
      jacobians(values, blocks);
    else if (request_.derivative == Derivative::kHessian)
      hessians(weighted(values), with, blocks);
    else
      gradients(weighted(values), blocks);
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
    for (size_t w = 0; w < with.size(); ++w) {
      SparseMatrix part;
      for (size_t k = 0; k < J.value.size(); ++k)
        if (first[w] <= J.col[k] && J.col[k] < first[w + 1])
          part.push(J.row[k], J.col[k] - first[w], J.value[k]);
      output(signature_.outputs[w].name, part);
    }
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
      SparseMatrix part;
      for (size_t k = 0; k < H.value.size(); ++k)
        if (first[r] <= H.row[k] && H.row[k] < first[r + 1] && first[c] <= H.col[k] &&
            H.col[k] < first[c + 1])
          part.push(H.row[k] - first[r], H.col[k] - first[c], H.value[k]);
      output(signature_.outputs[p].name, part);
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
  return Tracer(request, setup, lowering).run();
}

}  // namespace arboc

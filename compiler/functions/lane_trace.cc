#include "functions/lane_trace.h"

#include <algorithm>
#include <map>

#include "functions/derived_signature.h"
#include "functions/lane_tree.h"
#include "functions/recursion.h"
#include "functions/run.h"
#include "graph/canonical.h"

namespace arboc {
namespace {

/// Those that combine limbs by limb_sum() only.
bool sums_limbs(const std::string& function) {
  constexpr const char* kFunctions[] = {"rnea", "gravity", "nle",
                                        "crba", "aba",     "rnea_derivatives"};
  return std::count(std::begin(kFunctions), std::end(kFunctions), function) > 0;
}

class LaneTracer {
 public:
  LaneTracer(const Signature& signature, const Setup& setup, const LoweringOptions& lowering)
      : signature_(signature),
        setup_(setup),
        builder_(signature.name),
        tree_(lane_tree(lower(setup, lowering), limbs_in_lanes(setup, lowering), builder_)) {}

  /// By the algorithm of `function`, whose outputs those asked for are, in the order of `outputs`.
  Graph run(const Signature& function, const std::vector<size_t>& outputs,
            const std::vector<Pattern>& patterns) {
    Arguments<Expr> inputs;
    builder_.begin_block("limbs side by side");
    for (const Argument& a : signature_.inputs)
      inputs[a.name] =
          gathered(builder_.input(a.name, a.rows * a.cols), a.name == "q" ? tree_.q : tree_.v);
    for (const Argument& a : function.inputs) inputs.try_emplace(a.name, tree_.v.size(), Expr(0));
    Signature reduced = function;
    for (Argument& a : reduced.outputs) {
      a.rows = tree_.tree.nv;
      a.cols = a.cols == 1 ? 1 : tree_.tree.nv;
    }
    auto results = arboc::run(reduced, tree_.tree, setup_, inputs);
    std::vector<Expr*> roots;
    for (const size_t k : outputs)
      for (Expr& x : results[k]) roots.push_back(&x);
    if (!function.positive.empty())
      for (Expr& x : results.back()) roots.push_back(&x);
    canonicalise(builder_, roots, NodeOrder::kByCones);
    for (size_t k = 0; k < outputs.size(); ++k) {
      const Argument& a = function.outputs[outputs[k]];
      const std::vector<Expr>& result = results[outputs[k]];
      output(signature_.outputs[k].code(),
             a.cols == 1 ? vector(result) : matrix(a, result, patterns[k]));
    }
    if (!function.positive.empty()) output(function.positive, vector(results.back()));
    return std::move(builder_).finish();
  }

 private:
  std::vector<Expr> gathered(const std::vector<Ref>& entries,
                             const std::vector<std::vector<int>>& map) {
    std::vector<Expr> packs;
    for (const std::vector<int>& limbs : map) {
      std::vector<Expr> scalars;
      for (const int k : fill_lanes(limbs))
        scalars.emplace_back(&builder_, entries[static_cast<size_t>(k)]);
      packs.push_back(pack(builder_, scalars));
    }
    return packs;
  }

  std::vector<Expr> vector(const std::vector<Expr>& values) const {
    std::vector<Expr> all(static_cast<size_t>(setup_.nv));
    for (size_t k = 0; k < values.size(); ++k)
      for (size_t l = 0; l < tree_.v[k].size(); ++l)
        all[static_cast<size_t>(tree_.v[k][l])] = lane(values[k], static_cast<int>(l));
    return all;
  }

  /// The entries of the pattern.
  std::vector<Expr> matrix(const Argument& a, const std::vector<Expr>& values,
                           const Pattern& pattern) const {
    std::map<std::pair<int, int>, Expr> entries;
    const size_t n = tree_.v.size();
    for (size_t i = 0; i < n; ++i) {
      for (size_t j = 0; j < n; ++j) {
        if (is_zero(values[i * n + j])) continue;
        const std::vector<int>&rows = tree_.v[i], &cols = tree_.v[j];
        for (size_t l = 0; l < std::max(rows.size(), cols.size()); ++l) {
          int row = rows[rows.size() == 1 ? 0 : l], col = cols[cols.size() == 1 ? 0 : l];
          if (a.symmetric && row > col) std::swap(row, col);
          entries[{row, col}] = lane(values[i * n + j], static_cast<int>(l));
        }
      }
    }
    std::vector<Expr> list;
    for (size_t k = 0; k < pattern.row.size(); ++k) {
      int row = pattern.row[k], col = pattern.col[k];
      if (a.symmetric && row > col) std::swap(row, col);
      list.push_back(entries[{row, col}]);
    }
    return list;
  }

  void output(const std::string& name, const std::vector<Expr>& values) {
    std::vector<Ref> refs;
    for (const Expr& value : values) refs.push_back(value.ref(builder_));
    builder_.output(name, refs);
  }

  const Signature& signature_;
  const Setup& setup_;
  Builder builder_;
  LaneTree tree_;
};

}  // namespace

std::vector<LimbGroup> limbs_in_lanes(const Setup& setup, const LoweringOptions& lowering) {
  return find_limbs(lower(setup, lowering), kMostLanes);
}

std::optional<Graph> trace_in_lanes(const Request& request, const Setup& setup,
                                    const LoweringOptions& lowering,
                                    const std::vector<Pattern>& patterns) {
  const JacobianRecursion* recursion = recursion_of(request, setup);
  if (request.derivative != Derivative::kNone && !recursion) return {};
  if (!sums_limbs(recursion ? recursion->function : request.function)) return {};
  if (!setup.parameters.empty() || !setup.loads.empty()) return {};
  if (limbs_in_lanes(setup, lowering).empty()) return {};
  const Signature asked = signature(request, setup);
  const Signature function = recursion ? signature(Request{recursion->function}, setup) : asked;
  std::vector<size_t> outputs;
  for (size_t k = 0; k < asked.outputs.size(); ++k) outputs.push_back(k);
  if (recursion) {
    const std::vector<std::string> with =
        derived_inputs(request, signature(Request{request.function}, setup));
    for (size_t& k : outputs) k = output_index(function, recursion->output(with[k]));
  }
  return LaneTracer(asked, setup, lowering).run(function, outputs, patterns);
}

}  // namespace arboc

// evaluate_generic(): a request by numbers.
#include "functions/run.h"
#include "functions/trace.h"

namespace arboc {
namespace {

/// Scatters what a graph computes into dense outputs.
Values evaluate_traced(const Request& request, const Setup& setup, const LoweringOptions& lowering,
                       const Values& inputs) {
  const Signature s = signature(request, setup);
  const Traced traced = trace(request, setup, lowering);
  std::vector<std::vector<double>> in;
  for (const Argument& a : s.inputs) in.push_back(inputs.at(a.name));
  const auto out = evaluate(traced.graph, in);
  Values values;
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    if (!a.sparse) {
      values[a.name] = out[k];
      continue;
    }
    std::vector<double>& dense = values[a.name];
    dense.resize(static_cast<size_t>(a.rows) * static_cast<size_t>(a.cols));
    const auto at = [&](int row, int col) -> double& {
      return dense[static_cast<size_t>(row) * static_cast<size_t>(a.cols) +
                   static_cast<size_t>(col)];
    };
    for (size_t e = 0; e < out[k].size(); ++e) {
      const int row = traced.patterns[k].row[e], col = traced.patterns[k].col[e];
      at(row, col) = out[k][e];
      if (a.symmetric) at(col, row) = out[k][e];
    }
  }
  return values;
}

}  // namespace

Values evaluate_generic(const Request& request, const Setup& setup, const LoweringOptions& lowering,
                        const Values& inputs) {
  if (defined_as(request).derivative != Derivative::kNone)
    return evaluate_traced(request, setup, lowering, inputs);
  const Signature s = signature(request, setup);
  const DynamicTree tree = lower(setup.model, lowering,
                                 numbers_with(setup.model, setup.joint_forces, setup.parameters,
                                              parameter_values(setup, inputs)));
  std::vector<std::vector<double>> results = run(s, tree, setup, inputs);
  Values values;
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    const Argument& a = s.outputs[k];
    std::vector<double>& result = results[k];
    const auto n = static_cast<size_t>(a.rows);
    for (size_t i = 0; a.symmetric && i < n; ++i)
      for (size_t j = 0; j < i; ++j) result[i * n + j] = result[j * n + i];
    values[a.name] = std::move(result);
  }
  return values;
}

}  // namespace arboc

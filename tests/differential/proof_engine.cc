#include "differential/proof_engine.h"

#include <limits>

#include "passes/passes.h"

namespace arboc::test {
namespace {

/// The dense form of what raw functions write.
std::vector<double> dense(const Argument& a, const Pattern& pattern,
                          const std::vector<double>& entries) {
  if (!a.sparse) return entries;
  MatrixXd matrix = MatrixXd::Zero(a.rows, a.cols);
  for (size_t k = 0; k < entries.size(); ++k) {
    matrix(pattern.row[k], pattern.col[k]) = entries[k];
    if (a.symmetric) matrix(pattern.col[k], pattern.row[k]) = entries[k];
  }
  return as_list(MatrixXd(matrix.transpose()).reshaped());
}

}  // namespace

const ProofEngine::Entry& ProofEngine::entry(const Request& request) {
  const std::string key = text(request);
  const auto found = entries_.find(key);
  if (found != entries_.end()) return found->second;
  const std::vector<LoweringOptions> all = lowerings(request.function);
  Traced traced = trace(request, setup_, all[lowering_ % all.size()]);
  Entry made{signature(request, setup_), run_passes(std::move(traced.graph)),
             std::move(traced.patterns)};
  return entries_.emplace(key, std::move(made)).first->second;
}

Values ProofEngine::operator()(const Request& request, const Values& inputs) {
  const Entry& e = entry(request);
  std::vector<std::vector<double>> in;
  for (const Argument& a : e.signature.inputs) in.push_back(inputs.at(a.name));
  const auto out = evaluate(e.graph, in);
  Values values;
  for (size_t k = 0; k < e.signature.outputs.size(); ++k)
    values[e.signature.outputs[k].name] = dense(e.signature.outputs[k], e.patterns[k], out[k]);
  return values;
}

VectorXd as_vector(const std::vector<double>& x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

MatrixXd as_matrix(const std::vector<double>& x, Eigen::Index rows) {
  return as_vector(x).reshaped<Eigen::RowMajor>(rows, static_cast<Eigen::Index>(x.size()) / rows);
}

std::vector<double> as_list(const VectorXd& x) { return {x.begin(), x.end()}; }

double apart(const MatrixXd& actual, const MatrixXd& expected) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (actual.rows() != expected.rows() || actual.cols() != expected.cols()) return kInfinite;
  if (actual.size() == 0) return 0;
  if (!actual.allFinite() || !expected.allFinite()) return kInfinite;
  return (actual - expected).cwiseAbs().maxCoeff() / std::max(1.0, expected.cwiseAbs().maxCoeff());
}

Values displaced(const Reference& reference, Values inputs, const std::string& name,
                 const VectorXd& step) {
  const VectorXd x = as_vector(inputs.at(name));
  inputs[name] =
      as_list(name == "q" || name == "q1" ? reference.integrate(x, step) : VectorXd(x + step));
  return inputs;
}

}  // namespace arboc::test

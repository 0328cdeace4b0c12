// Where everything goes: done once for a problem.
#include <algorithm>
#include <stdexcept>

#include "assembly.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

constexpr double kConstantTolerance = 1e-9;  ///< of rows that depend on nothing, in their scale

int size_of(const std::vector<double>& v) { return static_cast<int>(v.size()); }

}  // namespace

Assembly::Assembly(Problem problem)
    : problem_(std::move(problem)), variables_(problem_.variables()) {
  x_.assign(variables_.size(), 0);
  gradient_.assign(variables_.size(), 0);
  lay_out_functions();
  for (const Problem::Cost& cost : problem_.costs()) {
    costs_.push_back(lay_out(cost.value));
    weights_.push_back(cost.weight);
  }
  lay_out_rows();
  lay_out_jacobian();
  lay_out_hessian();
  gradients_ = constant_gradients_;
  output_weights_.assign(outputs_.size(), 0);
}

void Assembly::lay_out_functions() {
  const auto& evaluations = problem_.evaluations();
  for (int e = 0; e < static_cast<int>(evaluations.size()); ++e) {
    const auto same = std::find_if(batches_.begin(), batches_.end(), [&](const Batch& b) {
      return b.function == evaluations[e].function;
    });
    if (same == batches_.end())
      batches_.push_back({evaluations[e].function, {e}});
    else
      same->evaluations.push_back(e);
  }
  first_output_.resize(evaluations.size());
  raw_rows_.resize(evaluations.size());
  for (Batch& batch : batches_) {
    const Pattern& J = batch.function->jacobian_pattern();
    const int m = batch.function->outputs();
    batch.inputs = static_cast<int>(bindings_.size());
    batch.outputs = size_of(outputs_);
    batch.jacobian = static_cast<int>(raw_input_.size());
    batch.hessian = size_of(raw_hessian_);
    for (int k = 0; k < batch.size(); ++k) {
      const int e = batch.evaluations[k], first_input = static_cast<int>(bindings_.size());
      first_output_[e] = batch.outputs + k * m;
      raw_rows_[e].resize(m);
      for (const Affine& a : evaluations[e].inputs) {
        input_constants_.push_back(a.constant);
        auto& binding = bindings_.emplace_back();
        for (const Affine::Term& t : a.terms) binding.emplace_back(t.of.index, t.coefficient);
      }
      for (std::size_t n = 0; n < J.size(); ++n) {
        raw_rows_[e][J.row[n]].push_back(static_cast<int>(raw_input_.size()));
        raw_input_.push_back(first_input + J.col[n]);
      }
    }
    outputs_.resize(outputs_.size() + static_cast<std::size_t>(batch.size() * m));
    raw_hessian_.resize(raw_hessian_.size() + batch.function->hessian_pattern().size() *
                                                  static_cast<std::size_t>(batch.size()));
  }
  inputs_.resize(bindings_.size());
  raw_jacobian_.resize(raw_input_.size());
}

Assembly::Sum Assembly::lay_out(const Affine& a) {
  Sum sum;
  sum.constant = a.constant;
  sum.first = size_of(constant_gradients_);
  std::map<int, int> slots;
  const auto slot = [&](int variable) {
    const auto [it, is_new] = slots.try_emplace(variable, size_of(constant_gradients_));
    if (is_new) {
      sum.columns.push_back(variable);
      constant_gradients_.push_back(0);
    }
    return it->second;
  };
  for (const Affine::Term& t : a.terms) {
    if (t.of.evaluation < 0) {
      sum.variables.emplace_back(t.of.index, t.coefficient);
      constant_gradients_[slot(t.of.index)] += t.coefficient;
      continue;
    }
    sum.outputs.emplace_back(first_output_[t.of.evaluation] + t.of.index, t.coefficient);
    for (const int raw : raw_rows_[t.of.evaluation][t.of.index])
      for (const auto& [variable, c] : bindings_[raw_input_[raw]])
        to_gradients_.push_back({slot(variable), raw, t.coefficient * c});
  }
  return sum;
}

Assembly::Expression Assembly::lay_out(const Problem::Expression& e) {
  Expression out;
  out.of = e.of;
  for (const Affine& a : e.arguments) out.sums.push_back(lay_out(a));
  out.sums.push_back(lay_out(e.plus));
  const std::size_t n = e.arguments.size();
  out.arguments.assign(n, 0);
  out.slopes.assign(n + 1, 1);
  out.curvature.assign(n * n, 0);
  return out;
}

void Assembly::lay_out_rows() {
  groups_ = problem_.groups();
  for (const Problem::Row& row : problem_.rows()) {
    lines_.push_back(lay_out(row.value));
    rows_.push(row.lower, row.upper, row.scale);
  }
  drop_constant_rows();
  constraints_.assign(rows_.size(), 0);
}

void Assembly::drop_constant_rows() {
  need_values();
  has_values_ = false;
  std::vector<int> kept(lines_.size(), -1);
  Scales rows;
  std::vector<Expression> lines;
  for (std::size_t r = 0; r < lines_.size(); ++r) {
    const bool depends = std::any_of(lines_[r].sums.begin(), lines_[r].sums.end(),
                                     [](const Sum& s) { return !s.columns.empty(); });
    const double c = value(lines_[r]), slack = kConstantTolerance * rows_.scale[r];
    if (!depends) {
      if (rows_.lower[r] - slack <= c && c <= rows_.upper[r] + slack) continue;
      throw std::runtime_error("'" + groups_[problem_.rows()[r].group].name +
                               "': a row depends on no variable and does not hold");
    }
    kept[r] = static_cast<int>(lines.size());
    rows.push(rows_.lower[r], rows_.upper[r], rows_.scale[r]);
    lines.push_back(std::move(lines_[r]));
  }
  rows_ = std::move(rows);
  lines_ = std::move(lines);
  for (Group& group : groups_) {
    std::vector<int> members;
    for (const int r : group.members)
      if (kept[r] >= 0) members.push_back(kept[r]);
    group.members = std::move(members);
  }
}

void Assembly::lay_out_jacobian() {
  for (int r = 0; r < static_cast<int>(lines_.size()); ++r) {
    std::map<int, int> slots;
    for (std::size_t a = 0; a < lines_[r].sums.size(); ++a) {
      const Sum& sum = lines_[r].sums[a];
      for (int k = 0; k < static_cast<int>(sum.columns.size()); ++k) {
        const auto [it, is_new] =
            slots.try_emplace(sum.columns[k], static_cast<int>(jacobian_pattern_.size()));
        if (is_new) jacobian_pattern_.push(r, sum.columns[k]);
        lines_[r].to_row.push_back({it->second, sum.first + k, 1});
        lines_[r].to_row_argument.push_back(static_cast<int>(a));
      }
    }
  }
  jacobian_.assign(jacobian_pattern_.size(), 0);
}

int Assembly::hessian_entry(int i, int j) {
  const int row = std::max(i, j), col = std::min(i, j);
  const auto [it, is_new] =
      hessian_entries_.try_emplace(static_cast<std::int64_t>(row) * size_of(x_) + col,
                                   static_cast<int>(hessian_pattern_.size()));
  if (is_new) hessian_pattern_.push(row, col);
  return it->second;
}

void Assembly::lay_out_hessian() {
  for (const Batch& batch : batches_)
    for (int k = 0; k < batch.size(); ++k) lay_out_function_hessian(batch, k);
  for (Expression& e : lines_) lay_out_bends(e);
  for (Expression& e : costs_) lay_out_bends(e);
  hessian_.assign(hessian_pattern_.size(), 0);
  hessian_entries_.clear();
}

/// An entry (i, j) of a function's Hessian stands for (j, i) as well: both meet where two inputs
/// are sums with the same variable.
void Assembly::lay_out_function_hessian(const Batch& batch, int k) {
  const Pattern& H = batch.function->hessian_pattern();
  const int inputs = batch.inputs + k * batch.function->inputs();
  const int first = batch.hessian + k * static_cast<int>(H.size());
  for (int n = 0; n < static_cast<int>(H.size()); ++n) {
    const auto& left = bindings_[inputs + H.row[n]];
    const auto& right = bindings_[inputs + H.col[n]];
    for (std::size_t a = 0; a < left.size(); ++a) {
      const std::size_t end = H.row[n] == H.col[n] ? a + 1 : right.size();
      for (std::size_t b = 0; b < end; ++b) {
        const auto [u, cu] = left[a];
        const auto [v, cv] = right[b];
        const bool twice = u == v && (H.row[n] != H.col[n] || a != b);
        to_hessian_.push_back({hessian_entry(u, v), first + n, (twice ? 2 : 1) * cu * cv});
      }
    }
  }
}

void Assembly::lay_out_bends(Expression& e) {
  if (!e.of) return;
  for (int i = 0; i < static_cast<int>(e.arguments.size()); ++i) {
    for (int j = 0; j <= i; ++j) {
      if (!e.of->curved(i, j)) continue;
      const Sum &left = e.sums[i], &right = e.sums[j];
      Bend bend{i, j, {}};
      for (int a = 0; a < static_cast<int>(left.columns.size()); ++a) {
        const int end = i == j ? a + 1 : static_cast<int>(right.columns.size());
        for (int b = 0; b < end; ++b) {
          const int u = left.columns[a], v = right.columns[b];
          bend.products.push_back(
              {hessian_entry(u, v), left.first + a, right.first + b, u == v && i != j ? 2.0 : 1.0});
        }
      }
      e.bends.push_back(std::move(bend));
    }
  }
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

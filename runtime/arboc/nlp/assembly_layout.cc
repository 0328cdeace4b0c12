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
  use_threads(1);
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
  for (Batch& batch : batches_) lay_out_function(batch);
  inputs_.resize(static_cast<std::size_t>(input_sums_.size()));
  raw_jacobian_.resize(raw_input_.size());
}

void Assembly::lay_out_function(Batch& batch) {
  const Pattern &J = batch.function->jacobian_pattern(), &H = batch.function->hessian_pattern();
  const int m = batch.function->outputs();
  batch.inputs = input_sums_.size();
  batch.outputs = size_of(outputs_);
  batch.jacobian = static_cast<int>(raw_input_.size());
  batch.hessian = size_of(raw_hessian_);
  for (int k = 0; k < batch.size(); ++k) {
    const int e = batch.evaluations[k], first = input_sums_.size();
    first_output_[e] = batch.outputs + k * m;
    raw_rows_[e].resize(m);
    for (const Affine& a : problem_.evaluations()[e].inputs) input_sums_.push(a);
    for (std::size_t n = 0; n < J.size(); ++n) {
      raw_rows_[e][J.row[n]].push_back(static_cast<int>(raw_input_.size()));
      raw_input_.push_back(first + J.col[n]);
    }
    to_hessian_.begin_evaluation(input_sums_, first, input_sums_.size());
    const int hessian = batch.hessian + k * static_cast<int>(H.size());
    for (int n = 0; n < static_cast<int>(H.size()); ++n)
      to_hessian_.add(first + H.row[n], first + H.col[n], hessian + n);
  }
  outputs_.resize(outputs_.size() + static_cast<std::size_t>(batch.size() * m));
  raw_hessian_.resize(raw_hessian_.size() + H.size() * static_cast<std::size_t>(batch.size()));
}

Assembly::Sum Assembly::lay_out(const Affine& a) {
  Sum sum;
  sum.constant = a.constant;
  sum.first = size_of(constant_gradients_);
  std::vector<int> targets;
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
    for (const int raw : raw_rows_[t.of.evaluation][t.of.index]) {
      const int input = raw_input_[raw];
      targets.clear();
      for (int n = input_sums_.begin[input]; n < input_sums_.begin[input + 1]; ++n)
        targets.push_back(slot(input_sums_.variable[n]));
      to_gradients_.add(input_sums_, input, raw, t.coefficient, targets);
    }
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
    Expression& e = lines_[r];
    e.first_entry = static_cast<int>(jacobian_pattern_.size());
    std::map<int, int> slots;
    for (int a = 0; a < static_cast<int>(e.sums.size()); ++a) {
      const Sum& sum = e.sums[a];
      for (int k = 0; k < static_cast<int>(sum.columns.size()); ++k) {
        const auto [it, is_new] =
            slots.try_emplace(sum.columns[k], static_cast<int>(jacobian_pattern_.size()));
        if (is_new) jacobian_pattern_.push(r, sum.columns[k]);
        if (e.of) e.row.push_back({it->second, sum.first + k, a});
      }
    }
  }
  jacobian_.assign(jacobian_pattern_.size(), 0);
}

void Assembly::lay_out_hessian() {
  LowerTriangle triangle(size_of(x_));
  to_hessian_.list(triangle);
  for (const auto* list : {&lines_, &costs_})
    for (const Expression& e : *list)
      for_each_bend(e, [&](int, int, int, int, int u, int v) { triangle.add(u, v); });
  triangle.finish();
  triangle.for_each([&](int row, int col) { hessian_pattern_.push(row, col); });
  to_hessian_.lay_out(triangle);
  for (auto* list : {&lines_, &costs_})
    for (Expression& e : *list) lay_out_bends(e, triangle);
  hessian_.assign(hessian_pattern_.size(), 0);
}

/// Calls visit(i, j, a, b, u, v): arguments i >= j of a scalar function that bends by both, entries
/// a and b of their gradients, and the variables of these.
template <class Visit>
void Assembly::for_each_bend(const Expression& e, const Visit& visit) {
  for (int i = 0; e.of && i < static_cast<int>(e.arguments.size()); ++i) {
    for (int j = 0; j <= i; ++j) {
      if (!e.of->curved(i, j)) continue;
      const Sum &left = e.sums[i], &right = e.sums[j];
      for (int a = 0; a < static_cast<int>(left.columns.size()); ++a)
        for (int b = 0; b < (i == j ? a + 1 : static_cast<int>(right.columns.size())); ++b)
          visit(i, j, left.first + a, right.first + b, left.columns[a], right.columns[b]);
    }
  }
}

/// Where two arguments differ both products of a pair of variables meet in one entry.
void Assembly::lay_out_bends(Expression& e, const LowerTriangle& triangle) {
  for_each_bend(e, [&](int i, int j, int left, int right, int u, int v) {
    if (e.bends.empty() || e.bends.back().i != i || e.bends.back().j != j)
      e.bends.push_back({i, j, {}});
    e.bends.back().products.push_back(
        {triangle.entry(u, v), left, right, u == v && i != j ? 2.0 : 1.0});
  });
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

// Values at a point, along the ways that assembly_layout.cc has laid.
#include "assembly.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

/// Adds the time it lives to `seconds`.
class Stopwatch {
 public:
  explicit Stopwatch(double& seconds) : seconds_(seconds) {}
  ~Stopwatch() { seconds_ += std::chrono::duration<double>(Clock::now() - begin_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  double& seconds_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace

void Assembly::move_to(const double* x) {
  if (has_values_ && std::equal(x_.begin(), x_.end(), x)) return;
  x_.assign(x, x + x_.size());
  has_values_ = has_gradients_ = false;
}

void Assembly::need_values() {
  if (has_values_) return;
  input_sums_.evaluate(x_.data(), inputs_.data());
  const Stopwatch watch(time_.values);
  for (const Batch& b : batches_)
    b.function->values(b.size(), &inputs_[b.inputs], &outputs_[b.outputs]);
  has_values_ = true;
}

double Assembly::value(const Sum& sum) const {
  double s = sum.constant;
  for (const auto& [k, c] : sum.variables) s += c * x_[k];
  for (const auto& [k, c] : sum.outputs) s += c * outputs_[k];
  return s;
}

double Assembly::value(Expression& e) const {
  const double plus = value(e.sums.back());
  if (!e.of) return plus;
  for (std::size_t a = 0; a < e.arguments.size(); ++a) e.arguments[a] = value(e.sums[a]);
  return e.of->value(e.arguments.data()) + plus;
}

double Assembly::value(const Affine& a) {
  need_values();
  double s = a.constant;
  for (const Affine::Term& t : a.terms)
    s += t.coefficient * (t.of.evaluation < 0
                              ? x_[t.of.index]
                              : outputs_[first_output_[t.of.evaluation] + t.of.index]);
  return s;
}

double Assembly::objective() {
  need_values();
  const Stopwatch watch(time_.assembly);
  double sum = 0;
  for (std::size_t k = 0; k < costs_.size(); ++k)
    if (weights_[k] != 0) sum += weights_[k] * value(costs_[k]);
  return sum;
}

std::map<std::string, double> Assembly::costs() {
  need_values();
  std::map<std::string, double> sums;
  for (std::size_t k = 0; k < costs_.size(); ++k)
    sums[problem_.costs()[k].name] += value(costs_[k]);
  return sums;
}

const std::vector<double>& Assembly::constraints() {
  need_values();
  const Stopwatch watch(time_.assembly);
  for (std::size_t r = 0; r < lines_.size(); ++r) constraints_[r] = value(lines_[r]);
  return constraints_;
}

void Assembly::evaluate(Expression& e) {
  if (!e.of) return;
  for (std::size_t a = 0; a < e.arguments.size(); ++a) e.arguments[a] = value(e.sums[a]);
  e.of->derivatives(e.arguments.data(), e.slopes.data(), e.curvature.data());
}

void Assembly::need_gradients() {
  need_values();
  if (has_gradients_) return;
  {
    const Stopwatch watch(time_.jacobian);
    for (const Batch& b : batches_)
      b.function->jacobian(b.size(), &inputs_[b.inputs], &raw_jacobian_[b.jacobian]);
  }
  const Stopwatch watch(time_.assembly);
  std::copy(constant_gradients_.begin(), constant_gradients_.end(), gradients_.begin());
  team_->run([&](int member) {
    to_gradients_.run(input_sums_, member, raw_jacobian_.data(), gradients_.data());
  });
  for (Expression& e : lines_) evaluate(e);
  for (Expression& e : costs_) evaluate(e);
  has_gradients_ = true;
}

const std::vector<double>& Assembly::gradient() {
  need_gradients();
  const Stopwatch watch(time_.assembly);
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  for (std::size_t k = 0; k < costs_.size(); ++k) {
    if (weights_[k] == 0) continue;
    for (std::size_t a = 0; a < costs_[k].sums.size(); ++a) {
      const Sum& sum = costs_[k].sums[a];
      const double factor = weights_[k] * costs_[k].slopes[a];
      for (std::size_t n = 0; n < sum.columns.size(); ++n)
        gradient_[sum.columns[n]] += factor * gradients_[static_cast<std::size_t>(sum.first) + n];
    }
  }
  return gradient_;
}

const std::vector<double>& Assembly::jacobian() {
  need_gradients();
  const Stopwatch watch(time_.assembly);
  std::fill(jacobian_.begin(), jacobian_.end(), 0.0);
  for (const Expression& e : lines_) {
    if (!e.of) {
      const auto from = gradients_.begin() + e.sums[0].first;
      std::copy(from, from + static_cast<std::ptrdiff_t>(e.sums[0].columns.size()),
                jacobian_.begin() + e.first_entry);
    }
    for (const Part& p : e.row) jacobian_[p.target] += e.slopes[p.argument] * gradients_[p.source];
  }
  return jacobian_;
}

void Assembly::weigh(const Expression& e, double multiplier) {
  if (multiplier == 0) return;
  for (std::size_t a = 0; a < e.sums.size(); ++a)
    for (const auto& [output, c] : e.sums[a].outputs)
      output_weights_[output] += multiplier * e.slopes[a] * c;
}

void Assembly::bend(const Expression& e, double multiplier) {
  if (multiplier == 0) return;
  const std::size_t n = e.arguments.size();
  for (const Bend& b : e.bends) {
    const double factor = multiplier * e.curvature[static_cast<std::size_t>(b.i) * n + b.j];
    if (factor == 0) continue;
    for (const Product& p : b.products)
      hessian_[p.target] += factor * p.factor * gradients_[p.left] * gradients_[p.right];
  }
}

const std::vector<double>& Assembly::hessian(double sigma, const double* multipliers) {
  need_gradients();
  std::fill(output_weights_.begin(), output_weights_.end(), 0.0);
  for (std::size_t r = 0; r < lines_.size(); ++r) weigh(lines_[r], multipliers[r]);
  for (std::size_t k = 0; k < costs_.size(); ++k) weigh(costs_[k], sigma * weights_[k]);
  {
    const Stopwatch watch(time_.hessian);
    for (const Batch& b : batches_)
      b.function->hessian(b.size(), &inputs_[b.inputs], &output_weights_[b.outputs],
                          &raw_hessian_[b.hessian]);
  }
  const Stopwatch watch(time_.assembly);
  std::fill(hessian_.begin(), hessian_.end(), 0.0);
  team_->run([&](int member) { to_hessian_.run(member, raw_hessian_.data(), hessian_.data()); });
  for (std::size_t r = 0; r < lines_.size(); ++r) bend(lines_[r], multipliers[r]);
  for (std::size_t k = 0; k < costs_.size(); ++k) bend(costs_[k], sigma * weights_[k]);
  return hessian_;
}

void Assembly::use_threads(int count) {
  to_gradients_.share_out(count);
  to_hessian_.share_out(count);
  team_ = std::make_unique<Team>(count);
}

void Assembly::set_variable(int variable, double lower, double upper) {
  if (!(lower <= upper)) throw std::invalid_argument("set_variable: bounds cross");
  variables_.lower.at(variable) = lower;
  variables_.upper.at(variable) = upper;
}

void Assembly::set_row(int group, int member, double lower, double upper) {
  if (!(lower <= upper)) throw std::invalid_argument("set_row: bounds cross");
  const int row = groups_.at(group).members.at(member);
  rows_.lower[row] = lower;
  rows_.upper[row] = upper;
}

bool Assembly::set_weight(const std::string& name, double weight) {
  bool found = false;
  for (std::size_t k = 0; k < weights_.size(); ++k) {
    if (problem_.costs()[k].name != name) continue;
    weights_[k] = weight;
    found = true;
  }
  return found;
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

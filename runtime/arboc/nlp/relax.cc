#include "relax.hpp"

#include <algorithm>
#include <cmath>

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

constexpr double kMet = 1e-6;   ///< misses below this, in units of the scale, are none
constexpr double kPush = 1e-3;  ///< multipliers above this part of the largest push back

}  // namespace

Relaxed::Relaxed(Nlp& nlp, const std::vector<int>& groups, Miss miss)
    : nlp_(nlp),
      miss_(miss),
      sides_(miss == Miss::kSquared ? 1 : 2),
      own_(static_cast<int>(nlp.variables().size())),
      variables_(nlp.variables()),
      groups_(nlp.variable_groups()),
      jacobian_pattern_(nlp.jacobian_pattern()),
      hessian_pattern_(nlp.hessian_pattern()) {
  Group misses{"miss", "1", {}};
  for (const int g : groups) {
    for (const int row : nlp.row_groups().at(g).members) {
      relaxed_.push_back(row);
      for (int side = 0; side < sides_; ++side) {
        const int variable = static_cast<int>(variables_.size());
        misses.members.push_back(variable);
        variables_.push(sides_ == 1 ? -kInfinity : 0, kInfinity, nlp.rows().scale[row]);
        jacobian_pattern_.push(row, variable);
        if (miss == Miss::kSquared) hessian_pattern_.push(variable, variable);
      }
    }
  }
  groups_.push_back(misses);
  x_.resize(variables_.size());
  gradient_.resize(variables_.size());
}

void Relaxed::move_to(const double* x) {
  x_.assign(x, x + x_.size());
  nlp_.move_to(x);
}

double Relaxed::objective() {
  double sum = 0;
  for (std::size_t k = own_; k < x_.size(); ++k) {
    const double z = x_[k] / variables_.scale[k];
    sum += miss_ == Miss::kSquared ? z * z / 2 : z;
  }
  return sum;
}

const std::vector<double>& Relaxed::gradient() {
  for (std::size_t k = own_; k < x_.size(); ++k) {
    const double one = variables_.scale[k];
    gradient_[k] = miss_ == Miss::kSquared ? x_[k] / (one * one) : 1 / one;
  }
  return gradient_;
}

const std::vector<double>& Relaxed::constraints() {
  constraints_ = nlp_.constraints();
  for (std::size_t k = 0; k < relaxed_.size(); ++k)
    constraints_[relaxed_[k]] +=
        sides_ == 1 ? x_[own_ + k] : x_[own_ + 2 * k] - x_[own_ + 2 * k + 1];
  return constraints_;
}

const std::vector<double>& Relaxed::jacobian() {
  jacobian_ = nlp_.jacobian();
  for (std::size_t k = 0; k < relaxed_.size(); ++k) {
    jacobian_.push_back(1);
    if (sides_ == 2) jacobian_.push_back(-1);
  }
  return jacobian_;
}

const std::vector<double>& Relaxed::hessian(double sigma, const double* multipliers) {
  hessian_ = nlp_.hessian(0, multipliers);
  if (miss_ == Miss::kSquared)
    for (std::size_t k = own_; k < x_.size(); ++k)
      hessian_.push_back(sigma / (variables_.scale[k] * variables_.scale[k]));
  return hessian_;
}

std::vector<double> Relaxed::start(const std::vector<double>& x) {
  std::vector<double> all(x.begin(), x.begin() + own_);
  nlp_.move_to(all.data());
  const std::vector<double>& c = nlp_.constraints();
  const Scales& r = nlp_.rows();
  for (const int row : relaxed_) {
    const double low = std::max(r.lower[row] - c[row], 0.0),
                 high = std::max(c[row] - r.upper[row], 0.0);
    all.push_back(sides_ == 1 ? low - high : low);
    if (sides_ == 2) all.push_back(high);
  }
  return all;
}

namespace {

/// Groups of rows and of variables whose multipliers stand out, except `not_this`.
std::vector<std::string> pushing(const Nlp& nlp, const Solution& s, int own, int not_this) {
  const Scales &v = nlp.variables(), &r = nlp.rows();
  const auto row = [&](int k) { return std::fabs(s.multipliers.rows[k]) * r.scale[k]; };
  const auto bound = [&](int i) {
    return std::fabs(s.multipliers.lower[i] - s.multipliers.upper[i]) * v.scale[i];
  };
  double largest = 0;
  for (std::size_t k = 0; k < r.size(); ++k) largest = std::max(largest, row(static_cast<int>(k)));
  std::vector<std::string> names;
  const auto add = [&](const Group& group, const auto& strength) {
    const bool pushes = std::any_of(group.members.begin(), group.members.end(),
                                    [&](int k) { return strength(k) > kPush * largest; });
    if (pushes) names.push_back(group.name);
  };
  const auto& groups = nlp.row_groups();
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (static_cast<int>(g) != not_this) add(groups[g], row);
  for (const Group& group : nlp.variable_groups())
    if (!group.members.empty() && group.members[0] < own) add(group, bound);
  return names;
}

}  // namespace

Diagnosis diagnose(Nlp& nlp, const std::vector<double>& x, const std::vector<int>& elastic,
                   const SolverOptions& options) {
  Diagnosis out;
  SolverOptions plain = options;
  plain.warm = nullptr;
  plain.objective_scale = 1;
  Relaxed all(nlp, elastic, Miss::kAbsolute);
  const Solution least = solve(all, all.start(x), plain);
  out.x.assign(least.x.begin(), least.x.begin() + all.own_variables());
  const std::vector<GroupViolation> missed = violations(nlp, out.x);
  int first = -1;
  for (const int g : elastic) {
    const GroupViolation& v = missed[static_cast<std::size_t>(g)];
    const auto& members = nlp.row_groups()[g].members;
    const double one = members.empty() ? 1 : nlp.rows().scale[members[0]];
    if (v.largest <= kMet * one) continue;
    out.conflicts.push_back({v.name, v.unit, v.norm, v.largest});
    if (first < 0) first = g;
  }
  out.feasible = out.conflicts.empty() && largest_violation(nlp, out.x) <= kMet;
  // The nearest approach of each in turn, until one is found that the others allow.
  for (const int g : elastic) {
    if (out.feasible || out.has_nearest) break;
    Relaxed one(nlp, {g}, Miss::kSquared);
    Solution near = solve(one, one.start(out.x), plain);
    if (near.status != Status::kOptimal) near = solve(one, one.start(x), plain);
    if (near.status != Status::kOptimal) continue;
    out.has_nearest = true;
    out.nearest_x.assign(near.x.begin(), near.x.begin() + one.own_variables());
    out.nearest = violations(nlp, out.nearest_x)[static_cast<std::size_t>(g)].norm;
    out.held_by = pushing(one, near, one.own_variables(), g);
    const Group& group = nlp.row_groups()[g];
    const auto is_it = [&](const Conflict& c) { return c.group == group.name; };
    const auto at = std::find_if(out.conflicts.begin(), out.conflicts.end(), is_it);
    const Conflict nearest{group.name, group.unit, out.nearest, out.nearest};
    if (at != out.conflicts.end()) out.conflicts.erase(at);
    out.conflicts.insert(out.conflicts.begin(), nearest);
  }
  return out;
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

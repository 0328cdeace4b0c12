// What a point is worth, whoever found it.
#include <algorithm>
#include <cmath>

#include "solver.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

double outside(double x, double lower, double upper) {
  return std::max({lower - x, x - upper, 0.0});
}

/// z (x - bound) with z >= 0, in scaled units; 0 of bounds that do not exist.
double complementarity(double z, double gap) { return std::isfinite(gap) ? std::fabs(z * gap) : 0; }

}  // namespace

const char* text(Status status) {
  switch (status) {
    case Status::kOptimal: return "optimal";
    case Status::kInfeasible: return "infeasible";
    case Status::kStopped: break;
  }
  return "stopped";
}

double kkt_error(Nlp& nlp, const std::vector<double>& x, const Multipliers& m, double one) {
  const Scales &v = nlp.variables(), &r = nlp.rows();
  nlp.move_to(x.data());
  std::vector<double> slope = nlp.gradient();
  const std::vector<double>& J = nlp.jacobian();
  const Pattern& at = nlp.jacobian_pattern();
  for (std::size_t k = 0; k < J.size(); ++k) slope[at.col[k]] += J[k] * m.rows[at.row[k]];
  double stationarity = 0, product = 0, sum = 0, bounds = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (v.lower[i] == v.upper[i]) continue;
    const double to_scaled = v.scale[i] / one;
    stationarity =
        std::max(stationarity, std::fabs((slope[i] - m.lower[i] + m.upper[i]) * to_scaled));
    product = std::max({product, complementarity(m.lower[i] / one, x[i] - v.lower[i]),
                        complementarity(m.upper[i] / one, v.upper[i] - x[i])});
    sum += (std::fabs(m.lower[i]) + std::fabs(m.upper[i])) * to_scaled;
    bounds += 2;
  }
  nlp.move_to(x.data());
  const std::vector<double>& c = nlp.constraints();
  for (std::size_t k = 0; k < r.size(); ++k) {
    sum += std::fabs(m.rows[k]) * r.scale[k] / one;
    bounds += 1;
    if (r.lower[k] == r.upper[k]) continue;
    const double gap = m.rows[k] > 0 ? r.upper[k] - c[k] : c[k] - r.lower[k];
    // A multiplier of a bound that does not exist is wrong altogether.
    product = std::max(product, std::isfinite(gap) ? std::fabs(m.rows[k] / one * gap)
                                                   : std::fabs(m.rows[k] / one * r.scale[k]));
  }
  const double scale = std::max(100.0, bounds > 0 ? sum / bounds : 0) / 100;
  return std::max(stationarity, product) / scale;
}

std::vector<GroupViolation> violations(Nlp& nlp, const std::vector<double>& x) {
  nlp.move_to(x.data());
  const std::vector<double>& c = nlp.constraints();
  const Scales &r = nlp.rows(), &v = nlp.variables();
  std::vector<GroupViolation> all;
  const auto add = [&](const Group& group, const Scales& bounds, const double* at) {
    GroupViolation out{group.name, group.unit, 0, 0};
    for (const int k : group.members) {
      const double d = outside(at[k], bounds.lower[k], bounds.upper[k]);
      out.largest = std::max(out.largest, d);
      out.norm = std::hypot(out.norm, d);
    }
    all.push_back(std::move(out));
  };
  for (const Group& group : nlp.row_groups()) add(group, r, c.data());
  for (const Group& group : nlp.variable_groups()) add(group, v, x.data());
  return all;
}

double largest_violation(Nlp& nlp, const std::vector<double>& x) {
  nlp.move_to(x.data());
  const std::vector<double>& c = nlp.constraints();
  const Scales &r = nlp.rows(), &v = nlp.variables();
  double largest = 0;
  for (std::size_t k = 0; k < r.size(); ++k)
    largest = std::max(largest, outside(c[k], r.lower[k], r.upper[k]) / r.scale[k]);
  for (std::size_t i = 0; i < v.size(); ++i)
    largest = std::max(largest, outside(x[i], v.lower[i], v.upper[i]) / v.scale[i]);
  return largest;
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

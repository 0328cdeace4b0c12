// What a solution is worth, in the units and names of the task.
#include <algorithm>
#include <arboc/measures/torque.hpp>
#include <cmath>
#include <sstream>

#include "predict.h"

namespace posture {
namespace {

using namespace arboc::nlp;

constexpr double kNear = 1e-5;  ///< of the scale: at a limit

void add_torques(const Model& model, const Built& built, const std::vector<double>& x,
                 Result& result) {
  result.tau.assign(static_cast<std::size_t>(model.robot.size()), 0);
  for (int k = 0; k < built.tau.size(); ++k)
    result.tau[static_cast<std::size_t>(built.driven[static_cast<std::size_t>(k)])] =
        x[static_cast<std::size_t>(built.tau[k].index)];
}

/// [Thesis] (5.1), (5.2), (5.6), (5.7), and the largest normalised torque.
void add_measures(const Task& task, const Model& model, Result& result) {
  const Robot& robot = model.robot;
  const auto n = static_cast<std::size_t>(robot.size());
  const std::vector<double> relaxed = relaxed_of(task, model);
  double displacement = 0, torque = 0;
  std::vector<double> lower, upper, tau;
  for (std::size_t i = 0; i < n; ++i) {
    if (model.passive[i]) continue;
    displacement += (result.q[i] - relaxed[i]) * (result.q[i] - relaxed[i]);
    torque += result.tau[i] * result.tau[i];
    if (!std::isfinite(robot.tau_upper[i])) continue;
    tau.push_back(result.tau[i]);
    lower.push_back(robot.tau_lower[i]);
    upper.push_back(robot.tau_upper[i]);
  }
  const auto vector = [](std::vector<double>& v) {
    return Eigen::Map<Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  const arboc::TorqueLimits limits(vector(lower), vector(upper));
  result.max_normalised_torque =
      tau.empty() ? 0 : arboc::normalised_torque(vector(tau), limits).maxCoeff();
  result.measures = {
      {"displacement", displacement},
      {"torque", torque},
      {"normalised", arboc::normalised_torque_sum(vector(tau), limits).value},
      {"norm", arboc::normalised_torque_norm(vector(tau), limits, task.objective.p).value},
      {"maximum", result.max_normalised_torque}};
}

void add_reactions(const Task& task, const Model& model, const Built& built,
                   const std::vector<double>& x, Result& result) {
  result.reactions.clear();
  std::vector<double> placements(static_cast<std::size_t>(model.robot.placements->outputs()));
  model.robot.placements->values(1, x.data(), placements.data());
  for (std::size_t c = 0; c < built.reactions.size(); ++c) {
    std::array<double, 6> r{};
    for (int i = 0; i < 6; ++i)
      r[static_cast<std::size_t>(i)] = x[static_cast<std::size_t>(built.reactions[c][i].index)];
    if (task.contacts[c].own_axes) {
      const Eigen::Matrix3d turn =
          Placement(placements.data() + 12 * model.robot.frame(task.contacts[c].frame)).R;
      Eigen::Map<Eigen::Vector3d> f(r.data()), n(r.data() + 3);
      f = (turn * f).eval();
      n = (turn * n).eval();
    }
    result.reactions.push_back(r);
  }
}

void list_active(const Task& task, const Model& model, const Built& built,
                 const std::vector<double>& x, Result& result) {
  const Scales& v = built.nlp->variables();
  result.active.clear();
  const auto note = [&](int variable, const std::string& name) {
    const auto i = static_cast<std::size_t>(variable);
    if (v.lower[i] == v.upper[i]) return;
    const double near = kNear * v.scale[i];
    if (x[i] - v.lower[i] < near) result.active.push_back(name + " at its lower limit");
    if (v.upper[i] - x[i] < near) result.active.push_back(name + " at its upper limit");
  };
  for (int i = 0; i < built.q.size(); ++i)
    note(built.q[i].index, model.robot.coordinates[static_cast<std::size_t>(i)]);
  for (int k = 0; k < built.tau.size(); ++k)
    note(built.tau[k].index, "torque of " + model.robot.coordinates[static_cast<std::size_t>(
                                                built.driven[static_cast<std::size_t>(k)])]);
  const char* component[] = {"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
  for (std::size_t c = 0; c < built.reactions.size(); ++c)
    for (int i = 0; i < 6; ++i)
      note(built.reactions[c][i].index, task.contacts[c].name + " " + component[i]);
}

std::array<int, 6> size_of(const Nlp& nlp) {
  const Scales &v = nlp.variables(), &r = nlp.rows();
  const auto equal = [](const Scales& s) {
    int n = 0;
    for (std::size_t k = 0; k < s.size(); ++k) n += s.lower[k] == s.upper[k];
    return n;
  };
  const int rows = static_cast<int>(r.size());
  return {static_cast<int>(v.size()),
          equal(v),
          equal(r),
          rows - equal(r),
          static_cast<int>(nlp.jacobian_pattern().size()),
          static_cast<int>(nlp.hessian_pattern().size())};
}

/// 16.0 mm, 3.2 N m: lengths in mm, one digit behind the point.
std::string amount(double x, const std::string& unit) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(unit == "m" || x >= 1 ? 1 : 4);
  text << (unit == "m" ? 1000 * x : x) << ' ' << (unit == "m" ? "mm" : unit);
  return text.str();
}

}  // namespace

void report(const Task& task, const Model& model, const Built& built, const std::vector<double>& x,
            Result& result) {
  result.violations = violations(*built.nlp, x);
  result.size = size_of(*built.nlp);
  result.q.assign(x.begin(), x.begin() + built.q.size());
  add_torques(model, built, x, result);
  add_measures(task, model, result);
  add_reactions(task, model, built, x, result);
  list_active(task, model, built, x, result);
}

std::string explanation(const Diagnosis& d) {
  if (d.conflicts.empty()) return "no point was found that meets all constraints";
  const Conflict& first = d.conflicts[0];
  std::string out;
  if (d.has_nearest)
    out = "nearest " + amount(d.nearest, first.unit) + " from '" + first.group + "'";
  for (std::size_t k = d.has_nearest ? 1 : 0; k < d.conflicts.size(); ++k)
    out += (out.empty() ? "" : "; ") + std::string("'") + d.conflicts[k].group + "' misses by " +
           amount(d.conflicts[k].miss, d.conflicts[k].unit);
  for (std::size_t k = 0; k < d.held_by.size(); ++k)
    out += (k == 0 ? "; held off by " : ", ") + d.held_by[k];
  return out;
}

}  // namespace posture

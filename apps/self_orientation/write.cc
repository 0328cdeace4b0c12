#include "write.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace self_orientation {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegree = 3.14159265358979323846 / 180;

Json steps(const Task& task) {
  Json out = Json::array();
  for (const Step& s : task.steps) {
    Json angles = Json::object();
    for (const auto& [joint, angle] : s.q) angles[joint] = angle / kDegree;
    out.push_back({{"name", s.name}, {"duration", s.duration}, {"angles_deg", angles}});
  }
  return out;
}

Vector times(const Result& r) {
  return Eigen::Map<const Vector>(r.trajectory.times.data(),
                                  static_cast<Eigen::Index>(r.trajectory.times.size()));
}

}  // namespace

std::string json_text(const Model& model, const Task& task, const Result& r,
                      const std::optional<AimResult>& aim) {
  Json json;
  json["task"] = task.name;
  json["model"] = model.name;
  json["heading_deg"] = r.heading / kDegree;
  json["tilt_deg"] = r.tilt / kDegree;
  json["momentum_drift"] = r.momentum_drift;
  json["com_drift_m"] = r.com_drift;
  json["base_force_residual"] = r.base_residual;
  json["joint_closure_rad"] = r.closure;
  json["power_balance_w"] = r.power_balance;
  json["energy"] = r.energy;
  if (r.paper)
    json["paper_difference"] = {{"velocity", r.paper->velocity},
                                {"acceleration", r.paper->acceleration},
                                {"torque_nm", r.paper->torque},
                                {"momentum_rate", r.paper->momentum_rate}};
  json["peaks"] = Json::array();
  for (const study::Peak& p : r.peaks)
    json["peaks"].push_back({{"joint", p.joint}, {"torque_nm", p.torque}, {"time_s", p.time}});
  json["cycles"] = task.cycles;
  json["steps"] = steps(task);
  json["frames"] = r.trajectory.times.size();
  json["duration_s"] = r.trajectory.times.back();
  json["seconds"] = r.seconds;
  if (aim)
    json["aim"] = {{"heading_deg", task.aim.heading / kDegree},
                   {"found", aim->found},
                   {"reason", aim->reason},
                   {"iterations", aim->iterations},
                   {"seconds", aim->seconds}};
  return json.dump(2) + "\n";
}

std::string motion_csv(const Model& model, const Result& r) {
  const Trajectory& t = r.trajectory;
  const auto n = static_cast<Eigen::Index>(t.times.size());
  study::Rows q(n, model.nq), v(n, model.nv);
  for (Eigen::Index k = 0; k < n; ++k) {
    q.row(k) = t.q[static_cast<std::size_t>(k)].transpose();
    v.row(k) = t.v[static_cast<std::size_t>(k)].transpose();
  }
  std::vector<std::string> names = {"t", "x", "y", "z", "qx", "qy", "qz", "qw"};
  const auto add = [&](const std::string& prefix, const std::vector<std::string>& of) {
    for (const std::string& name : study::prefixed(prefix, of)) names.push_back(name);
  };
  add("q.", model.joints);
  add("v.", {"x", "y", "z", "rx", "ry", "rz"});
  add("v.", model.joints);
  add("tau.", model.joints);
  return study::csv(names, {times(r), q, v, r.torques});
}

study::Animation animation(const Model& model, const Task& task, const Result& r) {
  const Trajectory& t = r.trajectory;
  study::Animation out;
  out.name = task.name;
  // The axis of the world along the spine at the start.
  orientation(model, t.q[0]).col(model.up).cwiseAbs().maxCoeff(&out.up);
  out.bodies = model.frames;
  out.times = t.times;
  out.placements.resize(static_cast<Eigen::Index>(t.times.size()),
                        static_cast<Eigen::Index>(12 * model.frames.size()));
  for (std::size_t k = 0; k < t.times.size(); ++k) {
    const std::vector<double> at = model.fk(t.q[k]);
    out.placements.row(static_cast<Eigen::Index>(k)) =
        Eigen::Map<const Eigen::RowVectorXd>(at.data(), static_cast<Eigen::Index>(at.size()));
  }
  for (const auto& limb : model.limbs) out.add_limb(limb, model.paper ? 0.06 : 0.03);
  // What shows which way the body faces.
  const Eigen::Vector3d up = Eigen::Vector3d::Unit(model.up);
  const double top = model.paper ? 0.35 : 0.2;
  out.sticks.push_back({{0, -0.1 * up}, {0, top * up}, 0.12});
  out.sticks.push_back({{0, top * up}, {0, top * up + 0.25 * Eigen::Vector3d::UnitX()}, 0.03});
  return out;
}

study::Plot torque_plot(const Model& model, const Task& task, const Result& r) {
  study::Plot plot{"Joint torques", "t (s)", "N m", {}};
  // The joints that work hardest, and the measure of [Astronaut] Figure 15.
  std::vector<std::size_t> order(r.peaks.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::fabs(r.peaks[a].torque) > std::fabs(r.peaks[b].torque);
  });
  order.resize(std::min<std::size_t>(order.size(), 8));
  for (const std::size_t j : order)
    plot.lines.push_back({model.joints[j], times(r), r.torques.col(static_cast<Eigen::Index>(j))});
  plot.lines.push_back({"weighted sum of |tau|", times(r), r.weighted});
  const Manoeuvre manoeuvre(task, model);
  plot.marks = manoeuvre.ends();
  return plot;
}

study::Plot heading_plot(const Model& model, const Result& r) {
  Vector turn(static_cast<Eigen::Index>(r.trajectory.q.size())), tilt(turn.size());
  const Eigen::Matrix3d start = orientation(model, r.trajectory.q[0]);
  double before = 0;
  for (Eigen::Index k = 0; k < turn.size(); ++k) {
    const Eigen::Matrix3d now = orientation(model, r.trajectory.q[static_cast<std::size_t>(k)]);
    const Heading h = heading(start.transpose() * now, model.up);
    before += std::remainder(h.turn - before, 360 * kDegree);
    turn[k] = before / kDegree;
    tilt[k] = h.tilt / kDegree;
  }
  return {"Orientation of the body",
          "t (s)",
          "deg",
          {{"heading", times(r), turn}, {"tilt", times(r), tilt}}};
}

study::Page page(const Model& model, const Task& task, const Result& r,
                 const study::Animation& animation) {
  study::Page out;
  out.title = task.name;
  out.animation = &animation;
  out.paragraphs = {fmt::format(
      "{}: turned by {:.2f} deg in {:.2f} s ({} cycles), {:.2f} deg off upright at the end.",
      model.name, r.heading / kDegree, r.trajectory.times.back(), task.cycles, r.tilt / kDegree)};
  study::PageTable checks{"Held by physics", {"", "largest"}, {}};
  checks.rows = {
      {"momentum, of what the joints alone have", fmt::format("{:.1e}", r.momentum_drift)},
      {"centre of mass, moved", fmt::format("{:.1e} m", r.com_drift)},
      {"force or moment on the base", fmt::format("{:.1e} N, N m", r.base_residual)},
      {"power balance", fmt::format("{:.1e} W", r.power_balance)}};
  if (r.paper)
    checks.rows.push_back({"hip torques by the paper's formulas, difference",
                           fmt::format("{:.1e} N m", r.paper->torque)});
  study::PageTable energy{"Energy expenditure", {"measure", "over the motion"}, {}};
  for (const auto& [name, value] : r.energy)
    energy.rows.push_back({name, fmt::format("{:.4g}", value)});
  out.tables = {checks, energy};
  out.plots = {heading_plot(model, r), torque_plot(model, task, r)};
  return out;
}

}  // namespace self_orientation

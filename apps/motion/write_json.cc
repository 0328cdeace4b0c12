#include <nlohmann/json.hpp>

#include "write.h"

namespace motion {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Eigen::MatrixXd& m) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index k = 0; k < m.cols(); ++k) row.push_back(m(i, k));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json json_of(const Audit& a) {
  const auto when = [](const Worst& w) {
    Json out = {{"time_s", w.time}};
    if (!w.where.empty()) out["where"] = w.where;
    return out;
  };
  return {{"instants", a.instants},
          {"force_N", a.force.value},
          {"moment_Nm", a.moment.value},
          {"drift_mm", 1e3 * a.drift.value},
          {"turn_mrad", 1e3 * a.turn.value},
          {"torque_excess", a.torque_excess.value},
          {"joint_excess", a.joint_excess.value},
          {"friction_excess_N", a.friction_excess.value},
          {"overlap_mm", 1e3 * a.overlap.value},
          {"largest_normalised_torque", a.largest_normalised},
          {"worst",
           {{"force", when(a.force)},
            {"moment", when(a.moment)},
            {"drift", when(a.drift)},
            {"torque", when(a.torque_excess)}}}};
}

Json json_of(const Stage& s) {
  return {{"name", s.name},
          {"status", arboc::nlp::text(s.status)},
          {"reason", s.reason},
          {"control_points", s.control_points},
          {"frames", s.frames},
          {"contact_frames", s.contact_frames},
          {"torque_frames", s.torque_frames},
          {"variables", s.variables},
          {"rows", s.rows},
          {"jacobian_entries", s.jacobian},
          {"hessian_entries", s.hessian},
          {"iterations", s.iterations},
          {"objective", s.objective},
          {"maxima", s.maxima},
          {"kkt_error", s.kkt_error},
          {"violation", s.violation},
          {"seconds", s.seconds},
          {"cpu_seconds", s.cpu_seconds},
          {"build_seconds", s.build_seconds},
          {"derivative_seconds", s.derivative_seconds},
          {"hessian_seconds", s.hessian_seconds},
          {"function_seconds",
           {{"values", s.time.values},
            {"jacobian", s.time.jacobian},
            {"hessian", s.time.hessian},
            {"assembly", s.time.assembly}}},
          {"audit", json_of(s.audit)}};
}

/// Of a phase's start nothing but where it is known.
Json json_of(const posture::Result& r) {
  if (r.reactions.empty()) return {{"q", r.q}};
  return {{"objective", r.objective},
          {"seconds", r.seconds},
          {"largest_normalised_torque", r.max_normalised_torque},
          {"q", r.q},
          {"reactions", r.reactions}};
}

Json json_of(const arboc::BSpline& curve) {
  return {{"degree", curve.basis().degree()},
          {"knots", curve.basis().knots()},
          {"control_points", json_of(curve.points())}};
}

Json json_of(const Task& task, const Model& model, const Result& result) {
  Json out = {{"task", task.name},
              {"model", task.model},
              {"status", arboc::nlp::text(result.status)},
              {"reason", result.reason},
              {"duration_s", task.duration},
              {"seconds", result.seconds},
              {"posture_seconds", result.posture_seconds},
              {"audit_passes", result.audit_passes},
              {"audit", json_of(result.audit)},
              {"measures", result.measures}};
  out["stages"] = Json::array();
  for (const Stage& s : result.stages) out["stages"].push_back(json_of(s));
  out["start"] = json_of(result.start);
  out["end"] = json_of(result.end);
  out["coordinates"] = model.robot.coordinates;
  for (const arboc::nlp::Contact& c : task.start.posture.contacts)
    out["contacts"].push_back(c.name);
  if (result.motion) {
    out["curves"]["q"] = json_of(result.motion->q);
    out["curves"]["reactions"] = json_of(result.motion->reactions);
  }
  return out;
}

}  // namespace

std::string json_text(const Plan& plan, const Model& model, const Course& course) {
  Json out = json_of(whole(plan), model, whole(plan, course));
  for (std::size_t k = 0; plan.phases.size() > 1 && k < course.phases.size(); ++k)
    out["phases"].push_back(json_of(plan.phases[k], model, course.phases[k]));
  return out.dump(1) + '\n';
}

}  // namespace motion

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "write.h"

namespace posture {
namespace {

using Json = nlohmann::ordered_json;

Json starts(const Result& result) {
  Json list = Json::array();
  for (const Start& s : result.starts)
    list.push_back({{"status", text(s.status)},
                    {"reason", s.reason},
                    {"objective", s.objective},
                    {"kkt_error", s.kkt_error},
                    {"violation", s.violation},
                    {"iterations", s.iterations},
                    {"restarts", s.restarts},
                    {"seconds", s.seconds},
                    {"cpu_seconds", s.cpu_seconds},
                    {"derivative_seconds", s.derivative_seconds},
                    {"hessian_seconds", s.hessian_seconds}});
  return list;
}

Json reactions(const Task& task, const Result& result) {
  Json list = Json::array();
  for (std::size_t c = 0; c < result.reactions.size(); ++c) {
    const auto& r = result.reactions[c];
    list.push_back({{"contact", task.contacts[c].name},
                    {"force", {r[0], r[1], r[2]}},
                    {"moment", {r[3], r[4], r[5]}}});
  }
  return list;
}

Json conflicts(const arboc::nlp::Diagnosis& d) {
  Json out;
  out["groups"] = Json::array();
  for (const auto& c : d.conflicts)
    out["groups"].push_back({{"group", c.group}, {"miss", c.miss}, {"unit", c.unit}});
  if (d.has_nearest) {
    out["nearest"] = d.nearest;
    out["held_by"] = d.held_by;
  }
  return out;
}

}  // namespace

double quantile(std::vector<double> x, double part) {
  if (x.empty()) return 0;
  std::sort(x.begin(), x.end());
  const double at = part * static_cast<double>(x.size() - 1);
  return x[static_cast<std::size_t>(std::lround(at))];
}

std::string json_text(const Task& task, const Model& model, const Result& result) {
  Json json;
  json["task"] = task.name;
  json["model"] = task.model;
  json["status"] = text(result.status);
  json["reason"] = result.reason;
  json["objective"] = result.objective;
  json["measures"] = result.measures;
  json["kkt_error"] = result.kkt_error;
  json["max_violation"] = result.max_violation;
  json["max_normalised_torque"] = result.max_normalised_torque;
  json["iterations"] = result.iterations;
  json["seconds"] = result.seconds;
  json["coordinates"] = model.robot.coordinates;
  json["q"] = result.q;
  json["tau"] = result.tau;
  json["reactions"] = reactions(task, result);
  Json violations = Json::array();
  for (const auto& v : result.violations)
    violations.push_back({{"group", v.name}, {"largest", v.largest}, {"unit", v.unit}});
  json["violations"] = violations;
  json["active"] = result.active;
  if (!result.diagnosis.conflicts.empty()) json["conflicts"] = conflicts(result.diagnosis);
  json["problem"] = {{"variables", result.size[0]},        {"fixed", result.size[1]},
                     {"equalities", result.size[2]},       {"inequalities", result.size[3]},
                     {"jacobian_entries", result.size[4]}, {"hessian_entries", result.size[5]}};
  json["best"] = result.best;
  json["starts"] = starts(result);
  if (result.again)
    json["again"] = {{"status", text(result.again->status)},
                     {"iterations", result.again->iterations},
                     {"seconds", result.again->seconds},
                     {"cpu_seconds", result.again->cpu_seconds},
                     {"objective", result.again->objective}};
  return json.dump(1) + "\n";
}

}  // namespace posture

#include "write.h"

#include <fmt/format.h>

#include <arboc/measures/energy.hpp>
#include <nlohmann/json.hpp>

namespace optimal_control {
namespace {

using Json = nlohmann::ordered_json;

Json of(const Answer& a, const Played& played) {
  Json json = {{"method", text(a.method)},
               {"found", a.found},
               {"cost", a.cost},
               {"iterations", a.iterations},
               {"stop_reason", a.stop_reason},
               {"violation", a.violation},
               {"seconds", a.seconds},
               {"energy", played.energy}};
  if (a.method != Method::kLagrangeNewton) return json;
  json["minimum"] = a.minimum;
  json["log"] = Json::array();
  for (const auto& s : a.log)
    json["log"].push_back({{"objective", s.objective},
                           {"stationarity", s.stationarity},
                           {"violation", s.violation},
                           {"dx", s.dx},
                           {"dl", s.dl}});
  return json;
}

std::string title(const Answer& a) {
  return a.method == Method::kIpopt ? "Ipopt" : "Lagrange-Newton";
}

}  // namespace

std::string json_text(const std::string& task, const Question& question, const Result& r) {
  Json json;
  json["task"] = task;
  json["model"] = question.model->name;
  json["cost"] = r.answers[0].cost;
  json["iterations"] = r.answers[0].iterations;
  json["stop_reason"] = r.answers[0].stop_reason;
  json["duration_s"] = question.duration;
  json["before"] = {{"cost", r.before.cost}, {"energy", r.before.energy}};
  if (const char* warning = arboc::jerk_warning(question.basis)) json["warning"] = warning;
  json["answers"] = Json::array();
  for (std::size_t k = 0; k < r.answers.size(); ++k)
    json["answers"].push_back(of(r.answers[k], r.after[k]));
  return json.dump(2) + "\n";
}

std::string motion_csv(const Question& question, const Result& r) {
  const Played& p = r.after[0];
  std::vector<std::string> names = {"t"};
  for (const char* prefix : {"q.", "v.", "tau."})
    for (const std::string& name : study::prefixed(prefix, question.model->joints))
      names.push_back(name);
  return study::csv(names, {p.effort.time_column(), p.q, p.effort.rates, p.effort.torques});
}

std::string log_csv(const Answer& a) {
  std::string out = "iteration,objective,stationarity,violation,dx,dl,x,l,shift,fraction\n";
  for (std::size_t k = 0; k < a.log.size(); ++k) {
    const auto& s = a.log[k];
    out += fmt::format(
        "{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", k,
        s.objective, s.stationarity, s.violation, s.dx, s.dl, s.x, s.l, s.shift, s.fraction);
  }
  return out;
}

study::Animation animation(const std::string& task, const Question& question, const Result& r) {
  const Model& m = *question.model;
  const Played& p = r.after[0];
  study::Animation out;
  out.name = task;
  out.bodies = m.frames;
  out.times = p.times;
  out.placements.resize(p.q.rows(), static_cast<Eigen::Index>(12 * m.frames.size()));
  for (Eigen::Index k = 0; k < p.q.rows(); ++k)
    m.fk(p.q.row(k).transpose(), out.placements.row(k).data());
  for (const auto& limb : m.limbs) out.add_limb(limb, 0.04);
  return out;
}

std::vector<study::Plot> plots(const Question& question, const Result& r) {
  study::Plot squares{"Sum of squared torques", "t (s)", "N^2 m^2", {}};
  const auto add = [&](const std::string& name, const Played& p) {
    squares.lines.push_back(
        {name, p.effort.time_column(), p.effort.torques.rowwise().squaredNorm()});
  };
  add("quintic", r.before);
  for (std::size_t k = 0; k < r.answers.size(); ++k) add(title(r.answers[k]), r.after[k]);
  study::Plot torques{"Torques of the first answer", "t (s)", "N m", {}};
  for (int j = 0; j < question.model->size(); ++j)
    torques.lines.push_back({question.model->joints[static_cast<std::size_t>(j)],
                             r.after[0].effort.time_column(), r.after[0].effort.torques.col(j)});
  return {squares, torques};
}

study::Page page(const std::string& task, const Question& question, const Result& r,
                 const study::Animation& animation) {
  study::Page out;
  out.title = task;
  out.animation = &animation;
  study::PageTable answers{
      "Answers", {"", "Int sum tau^2 dt", "iterations", "time", "stopped because"}, {}};
  answers.rows.push_back({"quintic", fmt::format("{:.6g}", r.before.cost), "", "", ""});
  for (const Answer& a : r.answers) {
    out.paragraphs.push_back(fmt::format("{}: cost {:.8g}, {} iterations, {:.1f} ms: {}.", title(a),
                                         a.cost, a.iterations, 1e3 * a.seconds, a.stop_reason));
    answers.rows.push_back({title(a), fmt::format("{:.6g}", a.cost), std::to_string(a.iterations),
                            fmt::format("{:.1f} ms", 1e3 * a.seconds), a.stop_reason});
  }
  if (const char* warning = arboc::jerk_warning(question.basis))
    out.paragraphs.push_back(std::string("Of the measures: ") + warning + ".");
  study::PageTable energy{"Energy expenditure", {"measure", "plan"}, {}};
  for (const Answer& a : r.answers) energy.header.push_back(title(a));
  for (const auto& [name, value] : r.before.energy) {
    energy.rows.push_back({name, fmt::format("{:.4g}", value)});
    for (const Played& p : r.after)
      energy.rows.back().push_back(fmt::format("{:.4g}", p.energy.at(name)));
  }
  out.tables = {answers, energy};
  for (const Answer& a : r.answers) {
    if (a.log.empty()) continue;
    study::PageTable log{"Lagrange-Newton", {"iteration", "|F_q|", "|C|", "|dq|", "|dl|"}, {}};
    for (std::size_t k = 0; k < a.log.size(); ++k) {
      const auto& s = a.log[k];
      std::vector<std::string> row = {std::to_string(k)};
      for (const double x : {s.stationarity, s.violation, s.dx, s.dl})
        row.push_back(fmt::format("{:.2e}", x));
      log.rows.push_back(row);
    }
    out.tables.push_back(log);
  }
  out.plots = plots(question, r);
  return out;
}

}  // namespace optimal_control

#include "write.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace ladder {
namespace {

using Json = nlohmann::ordered_json;

std::vector<double> changes(const Result& r) {
  std::vector<double> out;
  for (const Contact& c : r.schedule) out.push_back(c.begin);
  return out;
}

}  // namespace

std::string json_text(const Task& task, const Result& r) {
  Json json;
  json["task"] = task.name;
  json["hand_error_m"] = r.hand_error;
  json["schedule"] = Json::array();
  for (const Contact& c : r.schedule)
    json["schedule"].push_back({{"begin_s", c.begin},
                                {"end_s", c.end},
                                {"holds", text(c.held)},
                                {"bar", c.bar},
                                {"moves", text(other(c.held))},
                                {"from", c.from},
                                {"to", c.to}});
  json["energy"] = r.energy;
  json["torso_mismatch_m_s"] = r.torso_mismatch;
  json["torso_mismatch_inside_m_s"] = r.torso_mismatch_inside;
  json["reroot_error"] = r.reroot_error;
  json["clearance_m"] = r.clearance;
  json["limit_excess_rad"] = r.limit_excess;
  json["joint_speed_rad_s"] = r.joint_speed;
  json["stretch"] = r.stretch;
  json["power_balance_j"] = r.power_balance;
  if (task.both) json["loop"] = {{"error", r.loop_error}, {"speed", r.loop_speed}};
  json["peaks"] = Json::array();
  for (const study::Peak& p : r.peaks)
    json["peaks"].push_back({{"joint", p.joint}, {"torque_nm", p.torque}, {"time_s", p.time}});
  json["largest_hand_force_n"] = std::max(r.hand_forces.leftCols<3>().rowwise().norm().maxCoeff(),
                                          r.hand_forces.rightCols<3>().rowwise().norm().maxCoeff());
  json["frames"] = r.effort.times.size();
  json["duration_s"] = r.effort.times.back();
  json["seconds"] = r.seconds;
  return json.dump(2) + "\n";
}

std::string motion_csv(const Result& r) {
  std::vector<std::string> names = {"t"};
  for (const char* prefix : {"q.", "v.", "tau."})
    for (const std::string& name : study::prefixed(prefix, joints())) names.push_back(name);
  for (const char* name : {"right.Fx", "right.Fy", "right.Fz", "left.Fx", "left.Fy", "left.Fz"})
    names.emplace_back(name);
  return study::csv(names,
                    {r.effort.time_column(), r.q, r.effort.rates, r.effort.torques, r.hand_forces});
}

std::string schedule_csv(const Result& r) {
  std::string out = "begin,end,holds,bar,moves,from,to\n";
  for (const Contact& c : r.schedule)
    out += fmt::format("{:.17g},{:.17g},{},{},{},{},{}\n", c.begin, c.end, text(c.held), c.bar,
                       text(other(c.held)), c.from, c.to);
  return out;
}

study::Plot weighted_plot(const Result& r) {
  return {"Weighted sum of the absolute joint torques",
          "t (s)",
          "N m",
          {{"sum", r.effort.time_column(), study::weighted_torques(r.effort)}},
          changes(r)};
}

study::Plot torque_plot(const Result& r) {
  study::Plot plot{"Joint torques", "t (s)", "N m", {}, changes(r)};
  for (int j = 0; j < kJoints; ++j)
    plot.lines.push_back(
        {joints()[static_cast<std::size_t>(j)], r.effort.time_column(), r.effort.torques.col(j)});
  return plot;
}

study::Page page(const Task& task, const Result& r) {
  study::Page out;
  out.title = task.name;
  out.animation = &r.animation;
  out.paragraphs = {
      task.both
          ? fmt::format("Both hands on the bars, {:.2f} s; the left hand stays to {:.1e} m.",
                        r.effort.times.back(), r.loop_error)
          : fmt::format("{} bars in {} periods and {:.2f} s; hands on their bars to {:.1e} m, "
                        "torso's speed of both levels of planning alike to {:.1e} m/s.",
                        task.bars, r.schedule.size(), r.effort.times.back(), r.hand_error,
                        r.torso_mismatch)};
  study::PageTable energy{"Energy expenditure", {"measure", "over the motion"}, {}};
  for (const auto& [name, value] : r.energy)
    energy.rows.push_back({name, fmt::format("{:.4g}", value)});
  study::PageTable work{"Workload", {"joint", "largest torque", "at"}, {}};
  for (const study::Peak& p : r.peaks)
    work.rows.push_back(
        {p.joint, fmt::format("{:.2f} N m", p.torque), fmt::format("{:.2f} s", p.time)});
  study::PageTable periods{"Periods", {"", "from", "to", "holds", "moves"}, {}};
  for (std::size_t k = 0; k < r.schedule.size(); ++k) {
    const Contact& c = r.schedule[k];
    periods.rows.push_back({std::to_string(k), fmt::format("{:.2f} s", c.begin),
                            fmt::format("{:.2f} s", c.end),
                            fmt::format("{} on {}", text(c.held), c.bar),
                            fmt::format("{} from {} to {}", text(other(c.held)), c.from, c.to)});
  }
  out.tables = {energy, work};
  if (!r.schedule.empty()) out.tables.push_back(periods);
  out.plots = {weighted_plot(r), torque_plot(r)};
  return out;
}

}  // namespace ladder

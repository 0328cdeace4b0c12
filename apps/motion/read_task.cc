// Task file -> Task.
#include <posture/read.h>

#include <cmath>
#include <filesystem>

#include "task.h"

namespace motion {
namespace {

using study::Table;

/// A posture task, of a table that may have a base beside the file.
void read_end(toml::table& document, Table& table, const char* key, End& end) {
  if (!table.table(key)) table.fail(std::string(key) + " is missing");
  const toml::table own = study::over_base(std::move(*document.get(key)->as_table()));
  end.posture = posture::task_of(own, key);
  end.has_objective = own.contains("objective");
  end.velocity = posture::read_numbers(table, (std::string(key) + "_velocity").c_str());
}

/// What the motion asks for, of postures whose tasks do not say.
posture::Objective posture_objective(const Objective& o) {
  posture::Objective out;
  out.displacement = o.displacement;
  out.torque = o.torque;
  out.normalised = o.normalised;
  out.maximum = o.maximum;
  if (o.displacement + o.torque + o.normalised + o.maximum == 0) out.displacement = 1;
  return out;
}

Via read_via(Table table, double duration) {
  const double time = table.number("time", duration / 2);
  if (!(time > 0 && time < duration)) table.fail("time is not between the ends");
  return {posture::read_target(table), time};
}

Curves read_curves(Table table) {
  Curves c;
  c.degree = table.whole("degree", c.degree, 3);
  c.control_points = table.whole("control_points", c.control_points, c.degree + 4);
  c.reaction_points = table.whole("reaction_points", c.reaction_points, c.degree + 1);
  table.finish();
  return c;
}

Objective read_objective(Table table) {
  Objective o;
  const std::pair<const char*, double*> weights[] = {
      {"displacement", &o.displacement},
      {"torque", &o.torque},
      {"normalised", &o.normalised},
      {"maximum", &o.maximum},
      {"smoothness", &o.smoothness},
      {"acceleration", &o.acceleration},
      {"jerk", &o.jerk},
      {"reactions", &o.reactions},
      {"reaction_smoothness", &o.reaction_smoothness}};
  for (const auto& [key, value] : weights) {
    *value = table.number(key, *value);
    if (!(*value >= 0)) table.fail(std::string(key) + " is not a weight");
  }
  table.finish();
  return o;
}

double positive(Table& table, const char* key, double otherwise) {
  const double x = table.number(key, otherwise);
  if (!(x > 0)) table.fail(std::string(key) + " is not above 0");
  return x;
}

Tolerance read_tolerance(Table table) {
  Tolerance t;
  t.force = positive(table, "force", t.force);
  t.moment = positive(table, "moment", t.moment);
  t.drift = positive(table, "drift", t.drift);
  t.torque = positive(table, "torque", t.torque);
  table.finish();
  return t;
}

Search read_search(Table table) {
  Search s;
  s.iterations = table.whole("iterations", s.iterations, 1);
  s.kkt = positive(table, "kkt", s.kkt);
  s.seconds = positive(table, "seconds", s.seconds);
  s.most_control_points = table.whole("most_control_points", s.most_control_points, 0);
  s.frames = table.whole("frames", s.frames, 0);
  s.between = table.whole("between", s.between, 0);
  s.smooth_first = table.flag("smooth_first", s.smooth_first);
  table.finish();
  return s;
}

void check(const Task& task, Table& table) {
  const auto& a = task.start.posture.contacts;
  const auto& b = task.end.posture.contacts;
  bool same = task.start.posture.model == task.end.posture.model && a.size() == b.size();
  for (std::size_t k = 0; same && k < a.size(); ++k) same = a[k].name == b[k].name;
  if (!same) table.fail("start and end have not the same model and contacts");
}

}  // namespace

Task read_task(const std::string& path) {
  toml::table document = study::read_document(path);
  Table table(document, "task");
  Task task;
  task.name = table.text("name", std::filesystem::path(path).stem().string());
  table.text("base", "");
  read_end(document, table, "start", task.start);
  read_end(document, table, "end", task.end);
  task.model = task.start.posture.model;
  task.duration = positive(table, "duration", task.duration);
  for (const Table& via : table.tables("via")) task.vias.push_back(read_via(via, task.duration));
  if (const auto inner = table.table("curves")) task.curves = read_curves(*inner);
  if (const auto inner = table.table("objective")) task.objective = read_objective(*inner);
  if (const auto inner = table.table("tolerance")) task.tolerance = read_tolerance(*inner);
  if (const auto inner = table.table("search")) task.search = read_search(*inner);
  for (End* end : {&task.start, &task.end})
    if (!end->has_objective) end->posture.objective = posture_objective(task.objective);
  check(task, table);
  table.finish();
  return task;
}

}  // namespace motion

// Task file -> Task.
#include <posture/read.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "task.h"

namespace motion {
namespace {

using arboc::nlp::Alignment;
using arboc::nlp::Contact;
using arboc::nlp::Limits;
using study::Table;

/// A posture task, of a table that may have a base beside the file.
void read_end(toml::table& document, Table& table, const char* key, End& end) {
  if (!table.table(key)) table.fail(std::string(key) + " is missing");
  const toml::table own = study::over_base(std::move(*document.get(key)->as_table()));
  end.posture = posture::task_of(own, key);
  end.has_objective = own.contains("objective");
  const std::string velocity = std::string(key) + "_velocity";
  const toml::node* node = table.find(velocity.c_str());
  end.any_velocity = node && node->value<std::string>() == "any";
  if (!end.any_velocity) end.velocity = posture::read_numbers(table, velocity.c_str());
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
  if (!(time > 0 && time < duration)) table.fail_at("time", "time is not between the ends");
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
    if (!(*value >= 0)) table.fail_at(key, std::string(key) + " is not a weight");
  }
  table.finish();
  return o;
}

double positive(Table& table, const char* key, double otherwise) {
  const double x = table.number(key, otherwise);
  if (!(x > 0)) table.fail_at(key, std::string(key) + " is not above 0");
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

/// Two contacts of one name are of one point of the body, and hold it in one place.
bool same_hold(const Contact& a, const Contact& b) {
  const auto same_axis = [](const Alignment& x, const Alignment& y) {
    return x.axis == y.axis && x.direction == y.direction && x.either_way == y.either_way;
  };
  return a.name == b.name && a.frame == b.frame && a.point == b.point &&
         a.place.kind == b.place.kind && a.place.at == b.place.at &&
         a.place.direction == b.place.direction && a.own_axes == b.own_axes &&
         std::equal(a.align.begin(), a.align.end(), b.align.begin(), b.align.end(), same_axis);
}

void check(const Task& task, Table& table) {
  if (task.start.any_velocity) table.fail("start_velocity is not one by coordinate");
  const std::vector<Contact>& a = task.start.posture.contacts;
  const std::vector<Contact>& b = task.end.posture.contacts;
  if (task.start.posture.model != task.end.posture.model)
    table.fail("start and end have not the same model");
  if (a.size() != b.size()) table.fail("start and end have not the same contacts");
  for (std::size_t k = 0; k < a.size(); ++k)
    if (!same_hold(a[k], b[k]))
      table.fail("contact '" + a[k].name +
                 "' does not hold the same point in the same place at start and end");
}

bool pushes(const Contact& contact) {
  const auto nothing = [](const Limits& l) { return l.lower == 0 && l.upper == 0; };
  return !(std::all_of(contact.force.begin(), contact.force.end(), nothing) &&
           std::all_of(contact.moment.begin(), contact.moment.end(), nothing));
}

/// Between two phases: of what holds on in both, and of what is let go.
void check_joint(const Task& before, const Task& next, const Table& table) {
  if (before.model != next.model) table.fail("phases have not the same model");
  if (!next.start.velocity.empty() || next.start.any_velocity)
    table.fail("start_velocity is that with which the phase before ends");
  if (const auto fresh = new_contacts(before, next); before.end.any_velocity && !fresh.empty())
    table.fail("contact '" + fresh.front() +
               "' is new: it does not move at the end of the phase before, so that end_velocity "
               "cannot be any");
  const std::vector<Contact>& held = next.start.posture.contacts;
  for (const Contact& contact : before.end.posture.contacts) {
    const auto same = std::find_if(held.begin(), held.end(),
                                   [&](const Contact& c) { return c.name == contact.name; });
    if (same != held.end() && !same_hold(contact, *same))
      table.fail("contact '" + contact.name +
                 "' does not hold the same point in the same place as in the phase before");
    if (same == held.end() && pushes(contact))
      table.fail("contact '" + contact.name +
                 "' is let go: at the end of the phase before its force and moment are 0");
  }
}

/// A motion, of which `before` is what comes before, or null.
Task task_of(toml::table& document, const std::string& name, const Task* before) {
  Table table(document, "task");
  Task task;
  task.name = table.text("name", name);
  table.text("base", "");
  if (before && !document.contains("start"))
    task.start.posture = before->end.posture;
  else
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
  if (before) check_joint(*before, task, table);
  table.finish();
  return task;
}

}  // namespace

std::vector<std::string> new_contacts(const Task& before, const Task& next) {
  const std::vector<Contact>& old = before.start.posture.contacts;
  std::vector<std::string> out;
  for (const Contact& contact : next.start.posture.contacts) {
    const bool held = std::any_of(old.begin(), old.end(),
                                  [&](const Contact& c) { return c.name == contact.name; });
    const bool holds = contact.place.kind != arboc::nlp::Place::Kind::kAbove || pushes(contact);
    if (holds && !held) out.push_back(contact.name);
  }
  return out;
}

bool End::at_rest() const {
  return !any_velocity &&
         std::all_of(velocity.begin(), velocity.end(), [](const auto& v) { return v.second == 0; });
}

Plan read_plan(const std::string& path) {
  toml::table document = study::read_document(path);
  const std::string stem = std::filesystem::path(path).stem().string();
  if (!document.contains("phase")) return {stem, {task_of(document, stem, nullptr)}};
  Table table(document, "task");
  Plan plan{table.text("name", stem), {}};
  table.text("base", "");
  if (table.tables("phase").empty()) table.fail("there is no phase");
  for (toml::node& node : *document.get("phase")->as_array()) {
    toml::table phase = study::over_base(std::move(*node.as_table()));
    const Task* before = plan.phases.empty() ? nullptr : &plan.phases.back();
    const std::filesystem::path base = phase["base"].value_or(std::string("phase"));
    plan.phases.push_back(task_of(phase, base.stem().string(), before));
  }
  table.finish();
  return plan;
}

Task read_task(const std::string& path) {
  Plan plan = read_plan(path);
  if (plan.phases.size() != 1) throw study::TaskError(path + ": error: it has phases");
  return std::move(plan.phases.front());
}

}  // namespace motion

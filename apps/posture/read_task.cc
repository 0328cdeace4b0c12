// Task file -> Task.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "read.h"

namespace posture {
namespace {

using arboc::nlp::Alignment;
using arboc::nlp::Contact;
using arboc::nlp::Limits;
using arboc::nlp::Load;
using arboc::nlp::Place;
using study::fail;
using study::number_of;
using study::Table;

constexpr double kDegree = 3.14159265358979323846 / 180;

Vector3 unit(Table& table, const char* key) {
  const Vector3 v = table.vector(key);
  if (!(v.norm() > 0)) fail(*table.find(key), std::string(key) + " has no direction");
  return v.normalized();
}

std::vector<Alignment> read_align(Table& table) {
  std::vector<Alignment> out;
  for (Table& entry : table.tables("align")) {
    out.push_back({unit(entry, "axis"), unit(entry, "direction"), entry.flag("either_way", false)});
    entry.finish();
  }
  if (out.size() > 2) table.fail("more than two axes are aligned");
  return out;
}

/// position = [x, y, z], or line, plane, above = { at, direction or normal }.
Place read_place(Table& table) {
  Place place;
  int kinds = 0;
  if (table.has("position")) {
    place = {Place::Kind::kPoint, table.vector("position"), Vector3::Zero()};
    ++kinds;
  }
  const std::pair<const char*, Place::Kind> others[] = {
      {"line", Place::Kind::kLine}, {"plane", Place::Kind::kPlane}, {"above", Place::Kind::kAbove}};
  for (const auto& [key, kind] : others) {
    std::optional<Table> inner = table.table(key);
    if (!inner) continue;
    place = {kind, inner->vector("at"),
             unit(*inner, kind == Place::Kind::kLine ? "direction" : "normal")};
    inner->finish();
    ++kinds;
  }
  if (kinds > 1) table.fail("position, line, plane and above exclude each other");
  return place;
}

std::array<Limits, 3> read_limits(Table& table, const char* key) {
  std::array<Limits, 3> out;
  const auto pairs = table.limits(key);
  for (std::size_t i = 0; i < 3; ++i) out[i] = {pairs[i][0], pairs[i][1]};
  return out;
}

Contact read_contact(Table table) {
  Contact c;
  c.name = table.text("name");
  c.frame = table.text("frame");
  c.point = table.vector("point", Vector3::Zero());
  c.place = read_place(table);
  c.align = read_align(table);
  c.force = read_limits(table, "force");
  c.moment = read_limits(table, "moment");
  const std::string axes = table.text("axes", "world");
  if (axes != "world" && axes != "own") fail(*table.find("axes"), "axes is neither world nor own");
  c.own_axes = axes == "own";
  if (table.has("friction")) {
    c.friction = table.number("friction", 0);
    if (c.friction < 0) table.fail("friction is below 0");
    c.normal = unit(table, "normal");
  }
  table.finish();
  return c;
}

Look read_look(Table table) {
  Look look;
  look.name = table.text("name");
  look.frame = table.text("frame");
  look.eye = table.vector("eye", Vector3::Zero());
  look.axis = unit(table, "axis");
  if (table.has("at")) look.at = table.vector("at");
  if (!look.at) look.direction = unit(table, "direction");
  look.weight = table.number("weight", 0);
  if (table.has("within")) look.within = kDegree * table.number("within", 0);
  if (look.at && look.within) table.fail("within is of a direction, not of a point");
  table.finish();
  return look;
}

Collision read_collision(Table table) {
  Collision out;
  out.margin = table.number("margin", out.margin);
  for (Table& entry : table.tables("sphere")) {
    Sphere s;
    s.name = entry.text("name");
    s.frame = entry.text("frame", "");
    s.centre = entry.vector("centre", Vector3::Zero());
    s.radius = entry.number("radius", 0);
    s.part = entry.text("part", s.name);
    if (!(s.radius > 0)) entry.fail("radius is not above 0");
    entry.finish();
    out.spheres.push_back(s);
  }
  if (const toml::node* ignore = table.find("ignore")) {
    const toml::array* list = ignore->as_array();
    if (!list) fail(*ignore, "ignore is not a list of pairs of parts");
    for (const toml::node& pair : *list) {
      const toml::array* names = pair.as_array();
      if (!names || names->size() != 2 || !names->get(0)->is_string() ||
          !names->get(1)->is_string())
        fail(pair, "ignore: not a pair of parts");
      out.ignore.emplace_back(*names->get(0)->value<std::string>(),
                              *names->get(1)->value<std::string>());
    }
  }
  table.finish();
  return out;
}

Objective read_objective(Table table) {
  Objective o;
  const std::pair<const char*, double*> weights[] = {{"displacement", &o.displacement},
                                                     {"torque", &o.torque},
                                                     {"normalised", &o.normalised},
                                                     {"norm", &o.norm},
                                                     {"maximum", &o.maximum},
                                                     {"reactions", &o.reactions},
                                                     {"p", &o.p}};
  for (const auto& [key, value] : weights) {
    *value = table.number(key, *value);
    if (!(*value >= 0)) table.fail(std::string(key) + " is not a weight");
  }
  if (o.p < 1) table.fail("p is below 1");
  table.finish();
  return o;
}

Search read_search(Table table) {
  Search s;
  s.starts = table.whole("starts", s.starts, 1);
  s.seed = static_cast<unsigned>(table.whole("seed", static_cast<int>(s.seed), 0));
  s.spread = table.number("spread", s.spread);
  if (!(s.spread >= 0 && s.spread <= 1)) table.fail("spread is not between 0 and 1");
  s.random = table.flag("random", s.random);
  s.restarts = table.whole("restarts", s.restarts, 0);
  s.iterations = table.whole("iterations", s.iterations, 1);
  table.finish();
  return s;
}

void read_mirrors(Table& table, Task& task) {
  for (Table& entry : table.tables("mirror")) {
    task.mirrors.push_back({entry.text("left"), entry.text("right"), entry.number("sign", 1)});
    entry.finish();
  }
}

void read_bodies(Table& table, Task& task) {
  for (const Table& entry : table.tables("contact")) task.contacts.push_back(read_contact(entry));
  for (Table& entry : table.tables("load")) {
    task.loads.push_back({entry.text("name"), entry.text("frame"),
                          entry.vector("point", Vector3::Zero()), entry.vector("force")});
    entry.finish();
  }
  for (Table& entry : table.tables("target")) {
    task.targets.push_back(read_target(entry));
  }
  for (const Table& entry : table.tables("look")) task.looks.push_back(read_look(entry));
}

}  // namespace

std::map<std::string, double> read_numbers(Table& table, const char* key) {
  std::map<std::string, double> out;
  if (std::optional<Table> inner = table.table(key))
    for (const auto& [name, node] : inner->raw())
      out[std::string(name.str())] =
          number_of(node, std::string(key) + ": " + std::string(name.str()));
  return out;
}

Target read_target(Table& table) {
  Target t{table.text("name"), table.text("frame"), table.vector("point", Vector3::Zero()),
           read_place(table), read_align(table)};
  if (table.has("offset")) t.place.at += table.vector("offset");
  table.finish();
  return t;
}

Task read_task(const std::string& path) {
  return task_of(study::read_document(path), std::filesystem::path(path).stem().string());
}

Task task_of(const toml::table& document, const std::string& name) {
  Table table(document, "task");
  Task task;
  task.name = table.text("name", name);
  table.text("base", "");
  task.model = table.text("model");
  const toml::node* relaxed = table.find("relaxed");
  if (relaxed && relaxed->is_string())
    task.relaxed_posture = table.text("relaxed");
  else
    task.relaxed = read_numbers(table, "relaxed");
  task.guess = read_numbers(table, "guess");
  task.torque_limits = table.flag("torque_limits", true);
  task.symmetric = table.flag("symmetric", false);
  task.asymmetry = table.number("asymmetry", task.asymmetry);
  if (!(task.asymmetry >= 0)) table.fail("asymmetry is below 0");
  read_mirrors(table, task);
  read_bodies(table, task);
  if (const auto inner = table.table("collision")) task.collision = read_collision(*inner);
  if (const auto inner = table.table("objective")) task.objective = read_objective(*inner);
  if (const auto inner = table.table("search")) task.search = read_search(*inner);
  table.finish();
  return task;
}

}  // namespace posture

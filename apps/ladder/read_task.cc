// Task file -> Task.
#include <filesystem>

#include "common/task_file.h"
#include "task.h"

namespace ladder {
namespace {

using study::Table;

constexpr double kDegree = 3.14159265358979323846 / 180;

Torso read_torso(Table table, Torso torso) {
  torso.x = table.number("x", torso.x);
  torso.z = table.number("z", torso.z);
  torso.pitch = kDegree * table.number("pitch", torso.pitch / kDegree);
  table.finish();
  return torso;
}

int read_elbow(Table& table, const char* key) {
  const std::string branch = table.text(key, "natural");
  if (branch != "natural" && branch != "other")
    study::fail(*table.find(key), "a branch is natural or other");
  return branch == "natural" ? 1 : -1;
}

BothHands read_both(Table table, const Torso& torso) {
  BothHands both;
  both.bars = {table.whole("right", 0, 0), table.whole("left", 0, 0)};
  both.to = torso;
  if (const auto to = table.table("to")) both.to = read_torso(*to, torso);
  table.finish();
  return both;
}

void read_limits(Table& table, Task& task) {
  task.torso_speed = table.number("torso_speed", task.torso_speed);
  task.joint_speed = kDegree * table.number("joint_speed", task.joint_speed / kDegree);
  if (!(task.torso_speed > 0 && task.joint_speed > 0)) table.fail("a speed limit is not above 0");
}

}  // namespace

const char* text(Hand hand) { return hand == kRight ? "right" : "left"; }

Task read_task(const std::string& path) {
  const toml::table document = study::read_document(path);
  Table table(document, "task");
  Task task;
  task.name = table.text("name", std::filesystem::path(path).stem().string());
  table.text("base", "");
  task.bars = table.whole("bars", task.bars, 1);
  task.spacing = table.number("spacing", task.spacing);
  task.duration = table.number("duration", task.duration);
  task.rate = table.rate(task.rate);
  task.clearance = table.number("clearance", task.clearance);
  if (!(task.spacing > 0 && task.duration > 0 && task.clearance >= 0))
    table.fail("spacing and duration are above 0, clearance is not below");
  const std::string first = table.text("first", "left"), gait = table.text("gait", "smooth");
  if (first != "left" && first != "right") table.fail("first is left or right");
  if (gait != "smooth" && gait != "stops") table.fail("gait is smooth or stops");
  task.first = first == "left" ? kLeft : kRight;
  task.stops = gait == "stops";
  if (const auto torso = table.table("torso")) task.torso = read_torso(*torso, task.torso);
  read_limits(table, task);
  if (auto elbows = table.table("elbows")) {
    task.elbows = {read_elbow(*elbows, "right"), read_elbow(*elbows, "left")};
    elbows->finish();
  }
  if (const auto legs = table.table("legs"))
    for (const auto& [name, node] : legs->raw())
      task.legs[std::string(name.str())] =
          kDegree * study::number_of(node, "legs: " + std::string(name.str()));
  if (auto floating = table.table("floating_legs")) {
    task.floating = Passive{floating->number("stiffness", 0), floating->number("damping", 0)};
    if (!(task.floating->stiffness >= 0 && task.floating->damping >= 0))
      floating->fail("stiffness or damping is below 0");
    floating->finish();
  }
  if (const auto both = table.table("both_hands")) task.both = read_both(*both, task.torso);
  table.finish();
  return task;
}

}  // namespace ladder

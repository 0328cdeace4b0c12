// Task file -> Task.
#include <algorithm>
#include <filesystem>

#include "common/task_file.h"
#include "task.h"

namespace self_orientation {
namespace {

using study::Table;

constexpr double kDegree = 3.14159265358979323846 / 180;

std::map<std::string, double> angles(const Table& table, const std::string& what) {
  std::map<std::string, double> out;
  for (const auto& [name, node] : table.raw())
    out[std::string(name.str())] =
        kDegree * study::number_of(node, what + ": " + std::string(name.str()));
  return out;
}

Step read_step(Table table) {
  Step step;
  step.name = table.text("name");
  step.duration = table.number("duration", step.duration);
  if (!(step.duration > 0)) table.fail("duration is not above 0");
  step.home = table.flag("home", false);
  if (const auto q = table.table("q")) step.q = angles(*q, "q");
  if (step.home != step.q.empty()) table.fail("a step has either angles q or home = true");
  table.finish();
  return step;
}

Aim read_aim(Table table, const std::vector<Step>& steps) {
  Aim aim;
  aim.wanted = true;
  aim.heading = kDegree * table.number("heading", 0);
  aim.most_cycles = table.whole("most_cycles", aim.most_cycles, 1);
  for (Table& entry : table.tables("free")) {
    const Free free{entry.text("step"), entry.text("joint")};
    const auto step = std::find_if(steps.begin(), steps.end(),
                                   [&](const Step& s) { return s.name == free.step; });
    if (step == steps.end() || !step->q.count(free.joint))
      entry.fail("step '" + free.step + "' has no angle of '" + free.joint + "'");
    entry.finish();
    aim.free.push_back(free);
  }
  if (aim.free.empty()) table.fail("no angle is free");
  table.finish();
  return aim;
}

}  // namespace

Task read_task(const std::string& path) {
  const toml::table document = study::read_document(path);
  Table table(document, "task");
  Task task;
  task.name = table.text("name", std::filesystem::path(path).stem().string());
  table.text("base", "");
  task.model = table.text("model");
  if (const auto start = table.table("start")) task.start = angles(*start, "start");
  for (const Table& entry : table.tables("step")) {
    Step step = read_step(entry);
    if (std::any_of(task.steps.begin(), task.steps.end(),
                    [&](const Step& s) { return s.name == step.name; }))
      entry.fail("there are two steps of this name");
    task.steps.push_back(std::move(step));
  }
  if (task.steps.empty()) table.fail("there are no steps");
  task.cycles = table.whole("cycles", 1, 1);
  task.rate = table.rate(task.rate);
  task.reverse = table.flag("reverse", false);
  task.time_scale = table.number("time_scale", 1);
  if (!(task.time_scale > 0)) table.fail("time_scale is not above 0");
  if (const auto aim = table.table("aim")) task.aim = read_aim(*aim, task.steps);
  table.finish();
  return task;
}

}  // namespace self_orientation

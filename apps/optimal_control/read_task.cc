// Task file -> Task.
#include <filesystem>

#include "common/task_file.h"
#include "task.h"

namespace optimal_control {
namespace {

using study::Table;

constexpr double kDegree = 3.14159265358979323846 / 180;

std::map<std::string, double> angles(Table& table, const char* key) {
  std::map<std::string, double> out;
  if (const auto inner = table.table(key))
    for (const auto& [name, node] : inner->raw())
      out[std::string(name.str())] =
          kDegree * study::number_of(node, std::string(key) + ": " + std::string(name.str()));
  return out;
}

Reach read_reach(Table table) {
  Reach reach;
  reach.frame = table.text("frame");
  reach.point = table.vector("point", reach.point);
  int given = 0;
  for (const char* axis : {"x", "y", "z"}) {
    reach.place.emplace_back();
    if (!table.has(axis)) continue;
    reach.place.back() = table.number(axis, 0);
    ++given;
  }
  if (given == 0) table.fail("none of x, y, z is given");
  table.finish();
  return reach;
}

std::vector<Method> read_methods(Table& table) {
  const toml::node* node = table.find("methods");
  if (!node) return {Method::kLagrangeNewton, Method::kIpopt};
  const toml::array* list = node->as_array();
  std::vector<Method> out;
  for (std::size_t k = 0; list && k < list->size(); ++k) {
    const auto name = list->get(k)->value<std::string>();
    for (const Method m : {Method::kLagrangeNewton, Method::kIpopt})
      if (name == text(m)) out.push_back(m);
  }
  if (!list || out.size() != list->size() || out.empty())
    study::fail(*node, "methods is no list of lagrange_newton and ipopt");
  return out;
}

}  // namespace

const char* text(Method method) {
  return method == Method::kLagrangeNewton ? "lagrange_newton" : "ipopt";
}

namespace {

/// What a period of the ladder brings with it.
void read_ends(Table& table, Task& task) {
  task.model = table.text("model");
  task.duration = table.number("duration", task.duration);
  if (!(task.duration > 0)) table.fail("duration is not above 0");
  task.start = angles(table, "start");
  task.end = angles(table, "end");
  if (const auto reach = table.table("reach")) task.reach = read_reach(*reach);
  task.smooth_ends = table.flag("smooth_ends", task.smooth_ends);
}

}  // namespace

Task read_task(const std::string& path) {
  const toml::table document = study::read_document(path);
  Table table(document, "task");
  Task task;
  task.name = table.text("name", std::filesystem::path(path).stem().string());
  table.text("base", "");
  if (auto ladder = table.table("ladder")) {
    const auto beside = std::filesystem::path(path).parent_path();
    task.ladder =
        LadderPeriod{(beside / ladder->text("task")).string(), ladder->whole("period", 0, 0)};
    ladder->finish();
  } else {
    read_ends(table, task);
  }
  task.smoothness = table.number("smoothness", task.smoothness);
  if (!(task.smoothness >= 0)) table.fail("smoothness is below 0");
  task.degree = table.whole("degree", task.degree, 2);
  task.control_points = table.whole("control_points", task.control_points, task.degree + 1);
  task.points_per_span = table.whole("points_per_span", task.points_per_span, 1);
  task.methods = read_methods(table);
  task.limits = table.flag("limits", task.limits);
  task.rate = table.rate(task.rate);
  task.max_iterations = table.whole("max_iterations", task.max_iterations, 1);
  table.finish();
  return task;
}

}  // namespace optimal_control

// self_orientation TASK.toml -o DIR: an astronaut afloat turns by moving the legs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "common/gltf.h"
#include "common/program.h"
#include "write.h"

namespace self_orientation {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

void print(const Task& task, const Result& r, const std::optional<AimResult>& aim) {
  fmt::print("{}: heading {:.4f} deg, tilt {:.4f} deg, {} cycles in {:.2f} s\n", task.name,
             r.heading / kDegree, r.tilt / kDegree, task.cycles, r.trajectory.times.back());
  fmt::print("momentum {:.1e} of the joints', centre of mass {:.1e} m, base {:.1e} N, N m\n",
             r.momentum_drift, r.com_drift, r.base_residual);
  if (r.paper)
    fmt::print(
        "formulas of the paper differ by {:.1e} in v0, {:.1e} in a0, {:.1e} N m in torques\n",
        r.paper->velocity, r.paper->acceleration, r.paper->torque);
  if (aim)
    fmt::print("aim at {:.4f} deg: {}, {} iterations, {:.0f} ms\n", task.aim.heading / kDegree,
               aim->found ? "found" : aim->reason, aim->iterations, 1e3 * aim->seconds);
  fmt::print("{} frames in {:.2f} ms\n", r.trajectory.times.size(), 1e3 * r.seconds);
}

int run(int argc, char** argv) {
  CLI::App app("turns a body in zero gravity by moving its joints");
  std::string path, folder;
  double heading = 0;
  app.add_option("task", path, "the task file (docs/astronaut.md)")->required();
  app.add_option("-o,--out", folder, "folder for result.json, tables, plots and index.html")
      ->required();
  const auto* aim_option =
      app.add_option("--heading", heading, "degrees, instead of the task's [aim]");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 1;
  }
  Task task = read_task(path);
  const Model& of = model(task.model);
  if (aim_option->count() > 0) {
    if (!task.aim.wanted) throw std::invalid_argument("--heading: the task has no [aim]");
    task.aim.heading = heading * kDegree;
  }
  std::optional<AimResult> aim;
  if (task.aim.wanted) {
    aim = find_heading(of, task);
    task = aim->task;
  }
  const Result result = report(of, task);
  const study::Animation moving = animation(of, task, result);
  study::write_files(folder, {{"result.json", json_text(of, task, result, aim)},
                              {"motion.csv", motion_csv(of, result)},
                              {"peaks.csv", study::peaks_csv(result.peaks)},
                              {"torques.svg", study::svg(torque_plot(of, task, result))},
                              {"heading.svg", study::svg(heading_plot(of, result))},
                              {"motion.glb", study::glb(moving)},
                              {"index.html", study::html(page(of, task, result, moving))}});
  print(task, result, aim);
  return aim && !aim->found ? 5 : 0;
}

}  // namespace
}  // namespace self_orientation

// Exit status as that of arboc: 1 usage, 2 input, 3 output, 4 internal, 5 ran but cannot turn so
// far.
int main(int argc, char** argv) {
  return study::exit_status([&] { return self_orientation::run(argc, argv); });
}

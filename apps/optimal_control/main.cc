// optimal_control TASK.toml -o DIR: a motion of least torque between two postures.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "common/gltf.h"
#include "common/program.h"
#include "write.h"

namespace optimal_control {
namespace {

int run(int argc, char** argv) {
  CLI::App app("finds the motion of least torque between two postures");
  std::string path, folder;
  app.add_option("task", path, "the task file (docs/astronaut.md)")->required();
  app.add_option("-o,--out", folder, "folder for result.json, tables, plots and index.html")
      ->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 1;
  }
  const Task task = read_task(path);
  Known plan;
  const Question asked = question(task, plan);
  const Result result = report(asked, task.methods, task.rate, plan);
  const study::Animation moving = animation(task.name, asked, result);
  const auto drawn = plots(asked, result);
  study::Files files = {{"result.json", json_text(task.name, asked, result)},
                        {"motion.csv", motion_csv(asked, result)},
                        {"cost.svg", study::svg(drawn[0])},
                        {"torques.svg", study::svg(drawn[1])},
                        {"motion.glb", study::glb(moving)},
                        {"index.html", study::html(page(task.name, asked, result, moving))}};
  bool found = true;
  for (const Answer& a : result.answers) {
    if (!a.log.empty()) files.emplace_back("lagrange_newton.csv", log_csv(a));
    found = found && a.found;
    fmt::print("{}: cost {:.10g} (quintic {:.6g}), {} iterations, {:.1f} ms: {}{}\n",
               text(a.method), a.cost, result.before.cost, a.iterations, 1e3 * a.seconds,
               a.stop_reason, a.minimum ? "; a minimum" : "");
  }
  study::write_files(folder, files);
  return found ? 0 : 5;
}

}  // namespace
}  // namespace optimal_control

// Exit status as that of arboc: 1 usage, 2 input, 3 output, 4 internal, 5 ran but a method found
// nothing.
int main(int argc, char** argv) {
  return study::exit_status([&] { return optimal_control::run(argc, argv); });
}

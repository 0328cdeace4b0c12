// ladder TASK.toml -o DIR: an astronaut goes along a ladder hand over hand.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "common/gltf.h"
#include "common/program.h"
#include "write.h"

namespace ladder {
namespace {

void print(const Task& task, const Result& r) {
  if (task.both)
    fmt::print("{}: both hands held to {:.1e} m and {:.1e} m/s\n", task.name, r.loop_error,
               r.loop_speed);
  else
    fmt::print(
        "{}: {} periods in {:.2f} s, hands {:.1e} m, torso {:.1e} m/s (inside {:.2g}), change of "
        "hands {:.1e}, clearance {:.3f} m\n",
        task.name, r.schedule.size(), r.effort.times.back(), r.hand_error, r.torso_mismatch,
        r.torso_mismatch_inside, r.reroot_error, r.clearance);
  const auto hardest = std::max_element(
      r.peaks.begin(), r.peaks.end(),
      [](const auto& a, const auto& b) { return std::fabs(a.torque) < std::fabs(b.torque); });
  fmt::print("largest torque {:.2f} N m, {} at {:.2f} s; {} frames in {:.2f} ms\n", hardest->torque,
             hardest->joint, hardest->time, r.effort.times.size(), 1e3 * r.seconds);
}

int run(int argc, char** argv) {
  CLI::App app("moves an astronaut along a ladder, hand over hand");
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
  const Result result = task.both ? both_hands(task) : traverse(task);
  study::write_files(folder, {{"result.json", json_text(task, result)},
                              {"motion.csv", motion_csv(result)},
                              {"peaks.csv", study::peaks_csv(result.peaks)},
                              {"schedule.csv", schedule_csv(result)},
                              {"weighted.svg", study::svg(weighted_plot(result))},
                              {"torques.svg", study::svg(torque_plot(result))},
                              {"motion.glb", study::glb(result.animation)},
                              {"index.html", study::html(page(task, result))}});
  print(task, result);
  return 0;
}

}  // namespace
}  // namespace ladder

// Exit status as that of arboc: 1 usage, 2 input, 3 output, 4 internal, 5 ran but there is no such
// motion.
int main(int argc, char** argv) {
  return study::exit_status([&] { return ladder::run(argc, argv); });
}

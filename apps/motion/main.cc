// motion TASK.toml -o DIR: predicts a motion and writes what came out.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <map>

#include "common/gltf.h"
#include "common/program.h"
#include "figures.h"
#include "write.h"

namespace motion {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void interrupt(int) {
  interrupted = 1;
  std::signal(SIGINT, SIG_DFL);  // the next one ends the program
}

/// "0.3 (N m), 0.002 (m)": the largest of each unit; nothing where all holds.
std::string by_unit(const std::vector<arboc::nlp::GroupViolation>& violations) {
  std::map<std::string, double> largest;
  for (const auto& v : violations) largest[v.unit] = std::max(largest[v.unit], v.largest);
  std::string text;
  for (const auto& [unit, value] : largest)
    if (value > 0) text += fmt::format("{}{:.1e} ({})", text.empty() ? "" : ", ", value, unit);
  return text.empty() ? "0" : text;
}

bool show(const Iteration& i) {
  const arboc::nlp::Progress& p = i.progress;
  const std::string left =
      p.seconds_left > 0 ? fmt::format(", perhaps {:.1f} s to go", p.seconds_left) : "";
  fmt::print(stderr, "{:9s} {:4d}  objective {:<13.7g} violated by {}; {:.1f} s{}\n", i.stage.name,
             p.iteration, p.objective, by_unit(p.violations), i.seconds, left);
  return !interrupted;
}

void print(const Audit& a) {
  fmt::print(
      "  between frames, at {} instants: {:.2f} N, {:.2f} N m, {:.3f} mm, torques {:.2f} % beyond "
      "their limits (largest {:.3f})\n",
      a.instants, a.force.value, a.moment.value, 1e3 * a.drift.value, 1e2 * a.torque_excess.value,
      a.largest_normalised);
}

void print(const Task& task, const Result& result) {
  fmt::print("{}: {}: {}\n", task.name, text(result.status), result.reason);
  fmt::print("{:.2f} s, of these postures at the ends {:.2f} s\n", result.seconds,
             result.posture_seconds);
  for (const Stage& s : result.stages) {
    fmt::print(
        "{}: {}, {} control points, {} frames, {} variables, {} rows: {} iterations, {:.2f} s "
        "(CPU {:.2f}; set up {:.2f}, functions and derivatives {:.2f}), objective {:.6g}, KKT "
        "{:.1e}, violation {:.1e}\n",
        s.name, text(s.status), s.control_points, s.frames, s.variables, s.rows, s.iterations,
        s.seconds, s.cpu_seconds, s.build_seconds, s.derivative_seconds, s.objective, s.kkt_error,
        s.violation);
    print(s.audit);
  }
}

int run(int argc, char** argv) {
  CLI::App app("predicts the motion of a body between two postures, with its full dynamics");
  std::string path, folder;
  std::string from;
  bool quiet = false;
  Options options;
  app.add_option("task", path, "the task file (docs/motion_prediction.md)")->required();
  app.add_option("-o,--out", folder, "folder for result.json, tables, plots and index.html")
      ->required();
  auto* from_option = app.add_option("--from", from, "start from the motion of this result.json");
  app.add_flag("--reactions-only", options.reactions_only,
               "keep that motion, find its reactions and torques")
      ->needs(from_option);
  app.add_option("--threads", options.threads, "that evaluate functions")
      ->check(CLI::PositiveNumber);
  app.add_option("--blas-threads", options.blas_threads, "of the linear solver")
      ->check(CLI::PositiveNumber);
  app.add_flag("-q,--quiet", quiet, "no line an iteration");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 1;
  }
  const Plan plan = read_plan(path);
  const Task task = whole(plan);
  const Model& of =
      study::of_task(path, [&]() -> const Model& { return posture::model(task.model); });
  std::signal(SIGINT, interrupt);
  std::vector<Motion> starts;
  if (!from.empty()) starts = read_motions(from, of, plan);
  options.go_on = [quiet](const Iteration& i) { return quiet ? !interrupted : show(i); };
  const Course course =
      study::of_task(path, [&] { return predict_phases(plan, of, options, starts); });
  const Result result = whole(plan, course);
  const study::Animation moving = animation(task, of, result);
  study::Files files = {{"result.json", json_text(plan, of, course)},
                        {"trajectory.csv", trajectory_csv(of, result)},
                        {"reactions.csv", reactions_csv(task, result)},
                        {"motion.mot", opensim_text(coordinates_recording(of, result))},
                        {"torques.sto", opensim_text(torques_recording(of, result))},
                        {"reactions.mot", opensim_text(reactions_recording(task, of, result))},
                        {"frames.trc", trc_text(markers_recording(task, of, result))},
                        {"torques.svg", study::svg(torque_plot(of, result))},
                        {"balance.svg", study::svg(balance_plot(of, result))},
                        {"stroboscope.svg", stroboscope(of, result)},
                        {"motion.glb", study::glb(moving)},
                        {"index.html", study::html(page(task, of, result, moving))}};
  for (std::size_t c = 0; c < task.start.posture.contacts.size(); ++c)
    files.emplace_back(fmt::format("reaction_{}.svg", c + 1),
                       study::svg(reaction_plot(task, result, c)));
  study::write_files(folder, files);
  print(task, result);
  return result.status == arboc::nlp::Status::kOptimal ? 0 : 5;
}

}  // namespace
}  // namespace motion

// Exit status as that of arboc: 1 usage, 2 input, 3 output, 4 internal, 5 ran but found no motion
// that passes its audit.
int main(int argc, char** argv) {
  return study::exit_status([&] { return motion::run(argc, argv); });
}

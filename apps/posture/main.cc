// posture TASK.toml -o DIR: predicts a posture and writes what came out.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "common/program.h"
#include "write.h"

namespace posture {
namespace {

void write_all(const std::string& folder, const Task& task, const Model& model,
               const Result& result) {
  study::write_files(folder, {{"result.json", json_text(task, model, result)},
                              {"coordinates.csv", coordinates_csv(model, result)},
                              {"reactions.csv", reactions_csv(task, result)},
                              {"starts.csv", starts_csv(result)},
                              {"index.html", page(task, model, result)}});
}

void print(const Task& task, const Result& result) {
  fmt::print("{}: {}: {}\n", task.name, text(result.status), result.reason);
  fmt::print(
      "objective {:.8g}, largest normalised torque {:.4f}, KKT error {:.1e}, violation {:.1e}\n",
      result.objective, result.max_normalised_torque, result.kkt_error, result.max_violation);
  std::vector<double> seconds, cpu;
  double all = 0, derivatives = 0, hessians = 0;
  int solved = 0;
  for (const Start& s : result.starts) {
    seconds.push_back(s.seconds);
    cpu.push_back(s.cpu_seconds);
    all += s.seconds;
    derivatives += s.derivative_seconds;
    hessians += s.hessian_seconds;
    solved += s.status == arboc::nlp::Status::kOptimal;
  }
  fmt::print(
      "{} of {} starts solved; per start median {:.1f} ms, 95 % {:.1f} ms, worst {:.1f} ms (CPU "
      "median {:.1f} ms)\n",
      solved, result.starts.size(), 1e3 * quantile(seconds, 0.5), 1e3 * quantile(seconds, 0.95),
      1e3 * quantile(seconds, 1), 1e3 * quantile(cpu, 0.5));
  fmt::print("of the time: {:.0f} % in functions and derivatives, {:.0f} % in Hessians of them\n",
             1e2 * derivatives / std::max(all, 1e-9), 1e2 * hessians / std::max(all, 1e-9));
  if (result.again)
    fmt::print("again from there: {}, {} iterations, {:.1f} ms (CPU {:.1f} ms)\n",
               text(result.again->status), result.again->iterations, 1e3 * result.again->seconds,
               1e3 * result.again->cpu_seconds);
}

int run(int argc, char** argv) {
  CLI::App app("predicts the posture of a body at rest: joint angles, reactions and torques");
  std::string path, folder;
  int starts = 0, seed = -1;
  bool random = false;
  std::vector<double> move;
  app.add_option("task", path, "the task file (docs/posture.md)")->required();
  app.add_option("-o,--out", folder, "folder for result.json, tables and index.html")->required();
  app.add_option("--starts", starts, "number of starts, instead of the task's")
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", seed, "of the starts, instead of the task's")
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--random", random, "starts anywhere in the ranges of the joints");
  app.add_option("--move", move, "solve again with the first target moved by x y z (m)")
      ->expected(3);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 1;
  }
  Task task = read_task(path);
  if (starts > 0) task.search.starts = starts;
  if (seed >= 0) task.search.seed = static_cast<unsigned>(seed);
  task.search.random = task.search.random || random;
  const Model& of = study::of_task(path, [&]() -> const Model& { return model(task.model); });
  std::optional<Vector3> by;
  if (!move.empty()) by = Vector3(move[0], move[1], move[2]);
  const Result result = study::of_task(path, [&] { return predict(task, of, by); });
  write_all(folder, task, of, result);
  print(task, result);
  return result.status == arboc::nlp::Status::kOptimal ? 0 : 5;
}

}  // namespace
}  // namespace posture

int main(int argc, char** argv) {
  return study::exit_status([&] { return posture::run(argc, argv); });
}

// motion_compare PREDICTED MEASURED: how far a motion is from a recorded one, column by column.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "common/program.h"
#include "recording.h"

namespace motion {
namespace {

int run(int argc, char** argv) {
  CLI::App app("compares recordings (.csv, .mot, .sto, .trc) in the columns that both have");
  std::string predicted, measured, folder;
  app.add_option("predicted", predicted, "what motion wrote: trajectory.csv, motion.trc, ...")
      ->required();
  app.add_option("measured", measured, "motion capture, force plates, another program")->required();
  app.add_option("-o,--out", folder, "folder for comparison.csv");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 1;
  }
  const Recording a = read_recording(predicted), b = read_recording(measured);
  const std::vector<Difference> all = compare(a, b);
  if (a.degrees != b.degrees)
    fmt::print(stderr, "warning: one says that its angles are in degrees, the other does not\n");
  fmt::print("{:<24} {:>9} {:>12} {:>12} {:>12}\n", "column", "instants", "RMSE", "largest",
             "correlation");
  for (const Difference& d : all)
    fmt::print("{:<24} {:>9} {:>12.5g} {:>12.5g} {:>12.4f}\n", d.column, d.instants, d.rmse,
               d.largest, d.correlation);
  if (!folder.empty()) study::write_files(folder, {{"comparison.csv", comparison_csv(all)}});
  return 0;
}

}  // namespace
}  // namespace motion

int main(int argc, char** argv) {
  return study::exit_status([&] { return motion::run(argc, argv); });
}

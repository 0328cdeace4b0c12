// compare_motions PREDICTED MEASURED: how far a motion is from a recorded one, column by column.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "program.h"
#include "recording.h"

namespace study {
namespace {

int run(int argc, char** argv) {
  CLI::App app("compares recordings (.csv, .mot, .sto, .trc) in the columns that both have");
  std::string predicted, measured, prefix, folder;
  double shift = 0;
  app.add_option("predicted", predicted, "what a study wrote: trajectory.csv, motion.mot, ...")
      ->required();
  app.add_option("measured", measured, "motion capture, force plates, another program")->required();
  app.add_option("--prefix", prefix, "only columns whose names begin so: q., say");
  app.add_option("--shift", shift, "s, added to the times of what was measured");
  app.add_option("-o,--out", folder, "folder for comparison.csv");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 1;
  }
  const Recording a = read_recording(predicted);
  Recording b = read_recording(measured);
  b.times.array() += shift;
  const std::vector<Difference> all = compare(a, b, prefix);
  if (a.degrees != b.degrees)
    fmt::print(stderr, "warning: one says that its angles are in degrees, the other does not\n");
  fmt::print("{:<24} {:>9} {:>12} {:>12} {:>10} {:>12}\n", "column", "instants", "RMSE", "largest",
             "at s", "correlation");
  for (const Difference& d : all)
    fmt::print("{:<24} {:>9} {:>12.5g} {:>12.5g} {:>10.4g} {:>12.4f}\n", d.column, d.instants,
               d.rmse, d.largest, d.at, d.correlation);
  if (!folder.empty()) write_files(folder, {{"comparison.csv", comparison_csv(all)}});
  return 0;
}

}  // namespace
}  // namespace study

int main(int argc, char** argv) {
  return study::exit_status([&] { return study::run(argc, argv); });
}

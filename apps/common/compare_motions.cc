// compare_motions SIMULATED.csv CAPTURED.csv: root mean square and largest difference of each
// column.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "compare.h"
#include "program.h"

namespace {

int run(int argc, char** argv) {
  CLI::App app("compares two motions over time, a computed and a captured one, say");
  std::string simulated, captured, prefix = "q.";
  double shift = 0, scale = 1;
  bool degrees = false;
  app.add_option("simulated", simulated, "CSV with a column t (s), as studies write it")
      ->required();
  app.add_option("captured", captured, "another; columns of the same names are compared")
      ->required();
  app.add_option("--prefix", prefix, "of the columns: q. unless given");
  app.add_option("--shift", shift, "s, added to the times of the second motion");
  app.add_flag("--degrees", degrees, "the columns are angles in rad: report degrees");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 1;
  }
  if (degrees) scale = 180 / 3.14159265358979323846;
  fmt::print("column,rmse,largest,time\n");
  for (const auto& d :
       study::compare(study::read_csv(simulated), study::read_csv(captured), prefix, shift))
    fmt::print("{},{:.9g},{:.9g},{:.9g}\n", d.column, scale * d.rmse, scale * d.largest, d.at);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return study::exit_status([&] { return run(argc, argv); });
}

// arboc bench MODEL: generated against generic dynamics, timed in one translation unit.
#include "cli/bench.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace arboc::cli {
namespace {

/// ns per state; 0 where there is none.
struct Timing {
  double generated = 0, plain = 0, generic = 0;
};

Timing time(const Engines& engines, size_t function) {
  const BenchRow& row = engines.row(function);
  std::vector<Pass> passes{engines.generated(function)};
  if (row.lane_ops > 0) passes.push_back(engines.plain(function));
  if (row.has_generic) passes.push_back(engines.generic(function));
  const std::vector<double> ns = least_ns(passes, kStates);
  return {ns[0], row.lane_ops > 0 ? ns[1] : 0, row.has_generic ? ns.back() : 0};
}

void print_text(const BenchRow& row, const Timing& t) {
  const auto some = [](bool there, const std::string& text) { return there ? text : "-"; };
  const bool lanes = row.lane_ops > 0;
  fmt::print("{:<30} {:>10} {:>8} {:>14.1f} {:>12} {:>12} {:>7} {:>12.1e}\n", row.function, row.ops,
             some(lanes, fmt::format("{}", row.lane_ops)), t.generated,
             some(lanes, fmt::format("{:.1f}", t.plain)),
             some(row.has_generic, fmt::format("{:.1f}", t.generic)),
             some(row.has_generic, fmt::format("{:.2f}", t.generic / t.generated)), row.difference);
}

nlohmann::ordered_json json_of(const BenchRow& row, const Timing& t) {
  nlohmann::ordered_json json{{"function", row.function},
                              {"generated_ns", t.generated},
                              {"difference", row.difference},
                              {"operations", row.ops}};
  if (row.lane_ops > 0) json["plain_ns"] = t.plain;
  if (row.lane_ops > 0) json["operations_in_lanes"] = row.lane_ops;
  if (row.has_generic) json["generic_ns"] = t.generic;
  if (row.has_generic) json["ratio"] = t.generic / t.generated;
  return json;
}

}  // namespace

int run_bench(const Common& common) {
  CompileOptions options = common.compile;
  options.requests = requests(common);
  const Compilation compilation = compiled(common, options);
  const Engines engines(common, compilation, target(compilation, options));
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  if (!common.json)
    fmt::print("{:<30} {:>10} {:>8} {:>14} {:>12} {:>12} {:>7} {:>12}\n", "function", "operations",
               "in lanes", "generated ns", "plain ns", "generic ns", "ratio", "difference");
  bool agree = true;
  for (size_t k = 0; k < compilation.functions.size(); ++k) {
    const BenchRow& row = engines.row(k);
    progress(static_cast<int>(k) + 1, static_cast<int>(compilation.functions.size()),
             "timing " + row.function);
    const Timing ns = time(engines, k);
    progress_done();
    agree = agree && row.agrees();
    if (common.json)
      json.push_back(json_of(row, ns));
    else
      print_text(row, ns);
  }
  if (common.json) fmt::print("{}\n", dump(json, 1));
  flush_stdout();
  if (!agree) fmt::print(stderr, "error: generated and generic results differ\n");
  return agree ? kOk : kNo;
}

}  // namespace arboc::cli

// arboc bench MODEL --lanes: one state a call against many in lanes.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/words.h"
#include "cli/bench.h"
#include "cli/build.h"
#include "emit/emit.h"
#include "emit/template.h"

namespace arboc::cli {
namespace {

std::vector<Lanes> parse_lanes(const std::string& list) {
  std::vector<Lanes> lanes;
  for (const std::string& word : split(list)) {
    Lanes next;
    next.single = !word.empty() && word.back() == 'f';
    const std::string count = word.substr(0, word.size() - next.single);
    for (const int n : {2, 4, 8, 16})
      if (count == fmt::format("{}", n)) next.count = n;
    if (next.count == 0)
      throw UsageError("--lanes: expected 2, 4, 8 or 16, with f of floats, not " + printable(word));
    lanes.push_back(next);
  }
  if (lanes.empty()) throw UsageError("--lanes: the list is empty");
  return lanes;
}

/// ns per state and relative difference from one state a call: [0] that itself, then of each kind
/// of lanes within packs and from and to arrays.
struct Timing {
  std::vector<double> ns, difference;
  double generic = 0;  ///< 0 where there is none
};

std::string driver(const TargetModel& target, const std::vector<Lanes>& lanes) {
  std::string includes, variants, cases;
  for (const Lanes& l : lanes)
    variants +=
        fmt::format("  passes->template add<{}, {}>();\n", l.single ? "float" : "double", l.count);
  for (size_t k = 0; k < target.functions.size(); ++k) {
    const std::string& f = target.functions[k].signature.name;
    includes += fmt::format("#include \"{0}/{0}_{1}_double.cpp\"\n", target.name, f);
    cases += fmt::format("    case {}: ways = ways_of<{}::{}_fn>(states, in); break;\n", k,
                         target.name, f);
  }
  return fill("bench/lanes.cpp", {{"name", target.name},
                                  {"includes", includes},
                                  {"variants", variants},
                                  {"count", fmt::format("{}", target.functions.size())},
                                  {"cases", cases}});
}

Library build(const Common& common, const TargetModel& target, const std::vector<Lanes>& lanes,
              const std::string& folder) {
  Files files;
  for (const auto& [path, bytes] : emit(target)) files[target.name + "/" + path] = bytes;
  files["lanes.cpp"] = driver(target, lanes);
  return Library(build_library(common, folder, files, {"lanes.cpp"}));
}

/// Times a function in all ways, the generic one last where there is one.
Timing time(const LaneWays& ways, const Engines& engines, size_t function) {
  Timing timing;
  timing.difference = ways.open(function, engines.inputs(function));
  std::vector<Pass> passes;
  for (size_t way = 0; way < timing.difference.size(); ++way)
    passes.push_back(ways.pass(function, way));
  if (engines.row(function).has_generic) passes.push_back(engines.generic(function));
  timing.ns = least_ns(passes, kStates);
  if (engines.row(function).has_generic) {
    timing.generic = timing.ns.back();
    timing.ns.pop_back();
  }
  return timing;
}

/// One line a function and kind of lanes, all next to the same function at one state a call.
void print_text(const BenchRow& row, const Timing& timing, const std::vector<Lanes>& lanes) {
  const auto line = [&](const std::string& kind, double ns, const std::string& arrays,
                        double difference) {
    const std::string generic = row.has_generic ? fmt::format("{:.2f}", timing.generic / ns) : "-";
    fmt::print("{:<30} {:>6} {:>12.1f} {:>10.2f} {:>10} {:>12} {:>12.1e}\n", row.function, kind, ns,
               timing.ns[0] / ns, generic, arrays, difference);
  };
  line("1", timing.ns[0], "-", row.difference);
  for (size_t k = 0; k < lanes.size(); ++k)
    line(lanes[k].text(), timing.ns[2 * k + 1], fmt::format("{:.1f}", timing.ns[2 * k + 2]),
         timing.difference[2 * k + 1]);
}

nlohmann::ordered_json json_of(const BenchRow& row, const Timing& timing,
                               const std::vector<Lanes>& lanes) {
  nlohmann::ordered_json json{
      {"function", row.function}, {"operations", row.ops}, {"scalar_ns", timing.ns[0]}};
  if (row.has_generic) json["generic_ns"] = timing.generic;
  json["lanes"] = nlohmann::ordered_json::array();
  for (size_t k = 0; k < lanes.size(); ++k) {
    const double ns = timing.ns[2 * k + 1];
    json["lanes"].push_back({{"lanes", lanes[k].count},
                             {"scalar", lanes[k].single ? "float" : "double"},
                             {"ns", ns},
                             {"arrays_ns", timing.ns[2 * k + 2]},
                             {"ratio_to_scalar", timing.ns[0] / ns},
                             {"difference", timing.difference[2 * k + 1]}});
    if (row.has_generic) json["lanes"].back()["ratio_to_generic"] = timing.generic / ns;
  }
  return json;
}

/// Floats may differ by as much more as they have fewer bits.
bool agrees(const BenchRow& row, const Timing& timing, const std::vector<Lanes>& lanes) {
  bool agree = row.agrees();
  for (size_t k = 0; k < lanes.size(); ++k)
    agree = agree && timing.difference[2 * k + 1] <= row.allowed * (lanes[k].single ? 0x1p29 : 1);
  return agree;
}

}  // namespace

std::string Lanes::text() const { return fmt::format("{}{}", count, single ? "f" : ""); }

LaneWays::LaneWays(const Common& common, const TargetModel& target, const std::string& list)
    : lanes_(parse_lanes(list.empty() ? "4,8" : list)),
      library_(build(common, target, lanes_, folder_.path())) {}

std::vector<double> LaneWays::open(size_t function, const std::vector<const double*>& in) const {
  using Open = const double* (*)(int, int, const double* const*);
  const auto call = reinterpret_cast<Open>(library_.symbol("arboc_lanes_open"));
  const double* differences = call(static_cast<int>(function), kStates, in.data());
  return {differences, differences + 1 + 2 * lanes_.size()};
}

Pass LaneWays::pass(size_t function, size_t way) const {
  using Run = void (*)(int, int);
  const auto call = reinterpret_cast<Run>(library_.symbol("arboc_lanes_pass"));
  return [=] { call(static_cast<int>(function), static_cast<int>(way)); };
}

int run_bench_lanes(const Common& common, const std::string& list) {
  CompileOptions options = common.compile;
  options.requests = requests(common);
  const Compilation compilation = compiled(common, options);
  const TargetModel model = target(compilation, options);
  const Engines engines(common, compilation, model);
  const LaneWays ways(common, model, list);
  const std::vector<Lanes>& lanes = ways.lanes();
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  if (!common.json)
    fmt::print("{:<30} {:>6} {:>12} {:>10} {:>10} {:>12} {:>12}\n", "function", "lanes", "ns/state",
               "x scalar", "x generic", "arrays ns", "difference");
  bool agree = true;
  for (size_t k = 0; k < compilation.functions.size(); ++k) {
    const BenchRow& row = engines.row(k);
    progress(static_cast<int>(k) + 1, static_cast<int>(compilation.functions.size()),
             "timing " + row.function + " in lanes");
    const Timing timing = time(ways, engines, k);
    progress_done();
    agree = agree && agrees(row, timing, lanes);
    if (common.json)
      json.push_back(json_of(row, timing, lanes));
    else
      print_text(row, timing, lanes);
  }
  if (common.json) fmt::print("{}\n", dump(json, 1));
  flush_stdout();
  if (!agree) fmt::print(stderr, "error: results differ\n");
  return agree ? kOk : kNo;
}

}  // namespace arboc::cli

// arboc bench MODEL --lanes: one state a call against many in lanes.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/bench.h"
#include "cli/build.h"
#include "emit/emit.h"
#include "emit/template.h"

namespace arboc::cli {
namespace {

constexpr int kStates = 32;  // a multiple of all lanes

struct Lanes {
  int count = 0;
  bool single = false;  ///< float instead of double
  std::string text() const { return fmt::format("{}{}", count, single ? "f" : ""); }
};

std::vector<Lanes> parse_lanes(const std::string& list) {
  std::vector<Lanes> lanes;
  std::istringstream in(list);
  for (std::string word; std::getline(in, word, ',');) {
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
};

std::string driver(const TargetModel& target, const std::vector<Lanes>& lanes) {
  std::string includes, variants, cases;
  for (const Lanes& l : lanes)
    variants +=
        fmt::format("  passes.template add<{}, {}>();\n", l.single ? "float" : "double", l.count);
  for (size_t k = 0; k < target.functions.size(); ++k) {
    const std::string& f = target.functions[k].signature.name;
    includes += fmt::format("#include \"{0}/{0}_{1}_double.cpp\"\n", target.name, f);
    cases += fmt::format("    case {}: return bench<{}::{}_fn>(states, in, ns, difference);\n", k,
                         target.name, f);
  }
  return fill(
      "bench/lanes.cpp",
      {{"name", target.name}, {"includes", includes}, {"variants", variants}, {"cases", cases}});
}

std::vector<Timing> time_lanes(const Common& common, const Compilation& compilation,
                               const TargetModel& target, const std::vector<Lanes>& lanes) {
  const TemporaryFolder folder;
  Files files;
  for (const auto& [path, bytes] : emit(target)) files[target.name + "/" + path] = bytes;
  files["lanes.cpp"] = driver(target, lanes);
  const Library library(build_library(common, folder.path(), files, {"lanes.cpp"}));

  using Bench = void (*)(int, int, const double* const*, double*, double*);
  const auto bench = reinterpret_cast<Bench>(library.symbol("arboc_bench_lanes"));
  std::vector<Timing> timings;
  for (size_t k = 0; k < target.functions.size(); ++k) {
    const CompiledFunction& f = compilation.functions[k];
    progress(static_cast<int>(k) + 1, static_cast<int>(target.functions.size()),
             "timing " + f.signature.name + " in lanes");
    const Samples in = samples(f, compilation.setup, kStates);
    std::vector<const double*> pointers;
    for (const auto& x : in.inputs) pointers.push_back(x.data());
    Timing timing;
    timing.ns.resize(1 + 2 * lanes.size());
    timing.difference.resize(timing.ns.size());
    bench(static_cast<int>(k), kStates, pointers.data(), timing.ns.data(),
          timing.difference.data());
    timings.push_back(timing);
  }
  progress_done();
  return timings;
}

/// One line a function and kind of lanes, all next to the same function at one state a call.
void print_text(const BenchRow& row, const Timing& timing, const std::vector<Lanes>& lanes) {
  const auto line = [&](const std::string& kind, double ns, const std::string& arrays,
                        double difference) {
    const std::string generic = row.generic > 0 ? fmt::format("{:.2f}", row.generic / ns) : "-";
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
  if (row.generic > 0) json["generic_ns"] = row.generic;
  json["lanes"] = nlohmann::ordered_json::array();
  for (size_t k = 0; k < lanes.size(); ++k) {
    const double ns = timing.ns[2 * k + 1];
    json["lanes"].push_back({{"lanes", lanes[k].count},
                             {"scalar", lanes[k].single ? "float" : "double"},
                             {"ns", ns},
                             {"arrays_ns", timing.ns[2 * k + 2]},
                             {"ratio_to_scalar", timing.ns[0] / ns},
                             {"difference", timing.difference[2 * k + 1]}});
    if (row.generic > 0) json["lanes"].back()["ratio_to_generic"] = row.generic / ns;
  }
  return json;
}

/// Floats may differ by as much more as they have fewer bits.
bool agrees(const BenchRow& row, const Timing& timing, const std::vector<Lanes>& lanes) {
  bool agree = row.difference <= row.allowed;
  for (size_t k = 0; k < lanes.size(); ++k)
    agree = agree && timing.difference[2 * k + 1] <= row.allowed * (lanes[k].single ? 0x1p29 : 1);
  return agree;
}

}  // namespace

int run_bench_lanes(const Common& common, const std::string& list) {
  const std::vector<Lanes> lanes = parse_lanes(list.empty() ? "4,8" : list);
  CompileOptions options = common.compile;
  options.requests = requests(common);
  const Compilation compilation = compiled(common, options);
  const TargetModel model = target(compilation, options);
  const std::vector<BenchRow> rows = time_generic(common, compilation, model);
  const std::vector<Timing> timings = time_lanes(common, compilation, model, lanes);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  if (!common.json)
    fmt::print("{:<30} {:>6} {:>12} {:>10} {:>10} {:>12} {:>12}\n", "function", "lanes", "ns/state",
               "x scalar", "x generic", "arrays ns", "difference");
  bool agree = true;
  for (size_t k = 0; k < rows.size(); ++k) {
    agree = agree && agrees(rows[k], timings[k], lanes);
    if (common.json)
      json.push_back(json_of(rows[k], timings[k], lanes));
    else
      print_text(rows[k], timings[k], lanes);
  }
  if (common.json) fmt::print("{}\n", dump(json, 1));
  flush_stdout();
  if (!agree) fmt::print(stderr, "error: results differ\n");
  return agree ? kOk : kNo;
}

}  // namespace arboc::cli

// arboc bench MODEL --peers: generated code, the generic engine and other libraries, in one
// process, on the same states, results compared first.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/bench.h"
#include "describe.h"
#include "state_source.h"

namespace arboc::cli {
namespace {

std::optional<peers::Function> function_of(const std::string& name) {
  if (name == "rnea") return peers::Function::kRnea;
  if (name == "crba") return peers::Function::kCrba;
  if (name == "aba") return peers::Function::kAba;
  if (name == "minv") return peers::Function::kMinv;
  if (name == "rnea_derivatives") return peers::Function::kRneaDerivatives;
  return {};
}

/// The states that every function is timed on, as peers take them.
struct States {
  explicit States(const Setup& setup) {
    StateSource source(7);
    for (int s = 0; s < kStates; ++s) {
      const Values in = source.inputs(setup);
      values.push_back(in);
      for (size_t k = 0; k < x.size(); ++k) {
        const std::vector<double>& part = in.at(kNames[k]);
        x[k].insert(x[k].end(), part.begin(), part.end());
      }
    }
  }
  std::array<const double*, 4> pointers() const {
    return {x[0].data(), x[1].data(), x[2].data(), x[3].data()};
  }

  static constexpr const char* kNames[] = {"q", "v", "a", "tau"};
  std::vector<Values> values;
  std::array<std::vector<double>, 4> x;
};

/// One competitor for a function.
struct Contestant {
  std::string name;
  Pass pass;
  double difference = 0, allowed = 0;
  double ns = 0;
};

/// Relative to the largest entry; of symmetric outputs the upper triangle counts.
double difference(const std::vector<Argument>& outputs, const Values& expected,
                  const std::vector<double>& got) {
  double worst = 0;
  size_t at = 0;
  for (const Argument& a : outputs) {
    double error = 0, scale = 1e-9;
    const std::vector<double>& y = expected.at(a.name);
    for (int row = 0; row < a.rows; ++row)
      for (int col = 0; col < a.cols; ++col, ++at) {
        if (a.symmetric && row > col) continue;
        const double x = y[static_cast<size_t>(row * a.cols + col)];
        if (!(std::fabs(got[at] - x) <= error)) error = std::fabs(got[at] - x);
        scale = std::max(scale, std::fabs(x));
      }
    if (!(error / scale <= worst)) worst = error / scale;
  }
  return worst;
}

/// What the user asked for.
struct Asked {
  const Common& common;
  const PeerOptions& options;
  std::vector<PeerKind> kinds;
  const std::string* lanes = nullptr;  ///< null: none
};

class Competition {
 public:
  Competition(const Asked& asked, const Compilation& compilation, const TargetModel& target)
      : compilation_(compilation),
        states_(compilation.setup),
        engines_(asked.common, compilation, target) {
    if (asked.lanes) lanes_ = std::make_unique<LaneWays>(asked.common, target, *asked.lanes);
    const Model& model = compilation.setup.model;
    const Described described = describe(model);
    for (const PeerKind& kind : asked.kinds) {
      progress(1, 1, fmt::format("compiling {}", kind.name));
      std::string complaint;
      try {
        peers_.push_back(std::make_unique<PeerLibrary>(
            asked.common, asked.options, kind,
            PeerTask{described.body(model), kStates, states_.pointers()}));
      } catch (const std::runtime_error& e) {
        complaint = fmt::format("note: without {}: {}\n", kind.name, e.what());
      }
      progress_done();
      fmt::print(stderr, "{}", complaint);
    }
  }

  /// Everyone who has the function, generated code first, with results compared and times taken.
  std::vector<Contestant> run(size_t k) {
    std::vector<Contestant> all;
    const BenchRow& row = engines_.row(k);
    all.push_back({"generated", engines_.generated(k), row.difference, row.allowed, 0});
    if (row.lane_ops > 0)
      all.push_back({"generated, no limbs in lanes", engines_.plain(k), 0, row.allowed, 0});
    if (lanes_) add_lanes(k, all);
    if (row.has_generic) all.push_back({"generic", engines_.generic(k), 0, row.allowed, 0});
    if (const auto f = function_of(row.function)) add_peers(k, *f, all);
    std::vector<Pass> passes;
    for (const Contestant& c : all) passes.push_back(c.pass);
    const std::vector<double> ns = least_ns(passes, kStates);
    for (size_t i = 0; i < all.size(); ++i) all[i].ns = ns[i];
    return all;
  }

  const BenchRow& row(size_t k) const { return engines_.row(k); }

 private:
  void add_lanes(size_t k, std::vector<Contestant>& all) {
    const std::vector<double> differences = lanes_->open(k, engines_.inputs(k));
    for (size_t i = 0; i < lanes_->lanes().size(); ++i) {
      const Lanes& lanes = lanes_->lanes()[i];
      all.push_back({fmt::format("generated, {} {} in lanes", lanes.count,
                                 lanes.single ? "floats" : "doubles"),
                     lanes_->pass(k, 2 * i + 1), differences[2 * i + 1],
                     engines_.row(k).allowed * (lanes.single ? 0x1p29 : 1), 0});
    }
  }

  void add_peers(size_t k, peers::Function f, std::vector<Contestant>& all) {
    const CompiledFunction& compiled = compilation_.functions[k];
    size_t size = 0;
    for (const Argument& a : compiled.signature.outputs)
      size += static_cast<size_t>(a.rows) * static_cast<size_t>(a.cols);
    for (const auto& peer : peers_) {
      if (!peer->times(f)) continue;
      double worst = 0;
      for (int s = 0; s < kStates; ++s)
        worst = std::max(worst, difference(compiled.signature.outputs, expected(compiled, s),
                                           peer->result(f, s, size)));
      all.push_back({peer->kind().name, peer->pass(f), worst,
                     std::max(peer->kind().allowed, engines_.row(k).allowed), 0});
    }
  }

  Values expected(const CompiledFunction& f, int s) const {
    return evaluate_generic(f.request, compilation_.setup, f.lowering,
                            states_.values[static_cast<size_t>(s)]);
  }

  const Compilation& compilation_;
  States states_;
  Engines engines_;
  std::unique_ptr<LaneWays> lanes_;
  std::vector<std::unique_ptr<PeerLibrary>> peers_;
};

void check_comparable(const Setup& setup) {
  const Coordinates where = coordinates(setup.model);
  const Described described = describe(setup.model);
  if (described.joints.empty())
    throw UsageError("--peers: no peer knows spherical joints, or cosine and sine as coordinates");
  if (described.nv != where.nv)
    throw UsageError("--peers: no peer knows mimic joints; --mimic independent frees them");
  if (!setup.loads.empty() || setup.joint_forces.any() || !setup.parameters.empty())
    throw UsageError("--peers: not with --external-forces, --joint-forces or --parameters");
}

nlohmann::ordered_json json_of(const BenchRow& row, const std::vector<Contestant>& all) {
  nlohmann::ordered_json json{{"function", row.function}, {"operations", row.ops}};
  for (const Contestant& c : all)
    json["by"].push_back({{"name", c.name},
                          {"ns", c.ns},
                          {"ratio", c.ns / all[0].ns},
                          {"difference", c.difference}});
  return json;
}

}  // namespace

int run_bench_peers(const Common& common, const PeerOptions& options, const std::string* lanes) {
  CompileOptions compile_options = common.compile;
  Common asked = common;
  if (common.functions.empty() && common.compile.requests.empty())
    asked.functions = "rnea,crba,aba,minv,rnea_derivatives";
  compile_options.requests = requests(asked);
  const Compilation compilation = compiled(common, compile_options);
  const Asked all_asked{common, options, peer_kinds(options), lanes};
  check_comparable(compilation.setup);
  Competition competition(all_asked, compilation, target(compilation, compile_options));
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  if (!common.json)
    fmt::print("{:<20} {:<28} {:>12} {:>8} {:>12}\n", "function", "by", "ns/state", "ratio",
               "difference");
  bool agree = true;
  for (size_t k = 0; k < compilation.functions.size(); ++k) {
    const std::vector<Contestant> all = competition.run(k);
    for (const Contestant& c : all) {
      agree = agree && c.difference <= c.allowed;
      if (!common.json)
        fmt::print("{:<20} {:<28} {:>12.1f} {:>8.2f} {:>12.1e}\n", competition.row(k).function,
                   c.name, c.ns, c.ns / all[0].ns, c.difference);
    }
    if (common.json) json.push_back(json_of(competition.row(k), all));
    flush_stdout();
  }
  if (common.json) fmt::print("{}\n", dump(json, 1));
  flush_stdout();
  if (!agree) fmt::print(stderr, "error: results differ\n");
  return agree ? kOk : kNo;
}

}  // namespace arboc::cli

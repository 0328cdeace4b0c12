// What the timings of functions share: states, and generated against generic code.
#pragma once
#include <string>
#include <vector>

#include "cli/build.h"
#include "cli/common.h"
#include "cli/measure.h"
#include "cli/peer_library.h"
#include "emit/target.h"

namespace arboc::cli {

constexpr int kStates = 32;  ///< random ones; a multiple of all lanes

/// Inputs of a function at all states, one after the other, and what it should return where there
/// is no other engine.
struct Samples {
  std::vector<std::vector<double>> inputs;
  std::vector<double> known;
};
Samples samples(const CompiledFunction& f, const Setup& setup);

/// What is known of a function before it is timed.
struct BenchRow {
  std::string function;
  int ops = 0;
  int lane_ops = 0;  ///< with limbs in lanes; 0 where there are none
  bool has_generic = false;
  double allowed = 0;     ///< of the difference, relative to the largest entry
  double difference = 0;  ///< of generated and generic code, or of what is known, at the states
  bool agrees() const { return difference <= allowed; }
};

/// The functions of a model by generated and by generic code, compiled into one library.
class Engines {
 public:
  Engines(const Common& common, const Compilation& compilation, const TargetModel& target);

  const BenchRow& row(size_t function) const { return functions_[function].row; }
  /// The function's inputs at all states.
  const std::vector<const double*>& inputs(size_t function) const {
    return functions_[function].pointers;
  }
  Pass generated(size_t function) const {
    return [this, function] { run(function, 0); };
  }
  /// Without limbs in lanes.
  Pass plain(size_t function) const {
    return [this, function] { run(function, 3); };
  }
  Pass generic(size_t function) const {
    return [this, function] { run(function, 1); };
  }

 private:
  using Call = double (*)(int, int, int, const double* const*, const double*);
  struct Function {
    std::vector<std::vector<double>> inputs;
    std::vector<double> known;
    std::vector<const double*> pointers;
    BenchRow row;
  };

  double run(size_t function, int engine) const;

  TemporaryFolder folder_;
  Library library_;
  Call call_;
  std::vector<Function> functions_;
};

struct Lanes {
  int count = 0;
  bool single = false;  ///< float instead of double
  std::string text() const;
};

/// The functions of a model at one state a call and in lanes, compiled into one library.
class LaneWays {
 public:
  /// `list` as of --lanes; empty: "4,8".  Throws UsageError.
  LaneWays(const Common& common, const TargetModel& target, const std::string& list);

  const std::vector<Lanes>& lanes() const { return lanes_; }
  /// Ways are: 0 one state a call; 2 k + 1 lanes k within packs, 2 k + 2 from and to arrays.
  /// Takes the inputs at all states, which outlive the passes, and returns the largest relative
  /// difference of each way from way 0.
  std::vector<double> open(size_t function, const std::vector<const double*>& in) const;
  Pass pass(size_t function, size_t way) const;

 private:
  std::vector<Lanes> lanes_;
  TemporaryFolder folder_;
  Library library_;
};

/// arboc bench --lanes LIST, e.g. "4,8,8f": doubles, or with f floats, a pack.
int run_bench_lanes(const Common& common, const std::string& list);

/// arboc bench --peers; with `lanes`, also that many states at once.
int run_bench_peers(const Common& common, const PeerOptions& peers, const std::string* lanes);

}  // namespace arboc::cli

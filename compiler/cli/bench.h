// What the timings of functions share: states, and generated against generic code.
#pragma once
#include <string>
#include <vector>

#include "cli/common.h"
#include "emit/target.h"

namespace arboc::cli {

/// Inputs of a function at all states, one after the other, and what it should return where the
/// driver has no other engine.
struct Samples {
  std::vector<std::vector<double>> inputs;
  std::vector<double> known;
};
Samples samples(const CompiledFunction& f, const Setup& setup, int states);

/// One function: ns per state of one state a call; `generic` is 0 where there is none, `plain` (the
/// same without limbs in lanes) where no limbs are in lanes.
struct BenchRow {
  std::string function;
  double generated = 0, generic = 0, plain = 0, difference = 0;
  int ops = 0, lane_ops = 0;
  double allowed = 0;  ///< of the difference, relative to the largest entry
};
std::vector<BenchRow> time_generic(const Common& common, const Compilation& compilation,
                                   const TargetModel& target);

/// arboc bench --lanes LIST, e.g. "4,8,8f": doubles, or with f floats, a pack.
int run_bench_lanes(const Common& common, const std::string& list);

}  // namespace arboc::cli

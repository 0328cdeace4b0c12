// Least times of calls that compete.
#pragma once
#include <functional>
#include <vector>

namespace arboc::cli {

/// Goes through all states once.
using Pass = std::function<void()>;

/// ns per state of each pass, by the clock: the least of many windows of some 30 us, the passes in
/// turn, for `seconds` of CPU time each.  What disturbs a window only ever makes it longer.
std::vector<double> least_ns(const std::vector<Pass>& passes, int states, double seconds = 0.12);

}  // namespace arboc::cli

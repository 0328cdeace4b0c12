#include "cli/measure.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "cli/common.h"

namespace arboc::cli {
namespace {

/// ns that have passed.  The CPU time of a thread would leave out what other programs take, but of
/// short windows on virtual machines it can come out far too small.
double now() {
  return std::chrono::duration<double, std::nano>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// CPU time of this thread, ns: what the measurement may take.
double spent() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

}  // namespace

std::vector<double> least_ns(const std::vector<Pass>& passes, int states, double seconds) {
  std::vector<double> best(passes.size(), std::numeric_limits<double>::infinity());
  std::vector<int> repeat;
  for (const Pass& pass : passes) {
    pass();
    const double start = now();
    pass();
    repeat.push_back(static_cast<int>(30e3 / (now() - start)) + 1);
  }
  const double end = spent() + 1e9 * seconds * static_cast<double>(passes.size());
  while (spent() < end) {
    check_interrupt();
    for (size_t k = 0; k < passes.size(); ++k) {
      const double start = now();
      for (int r = 0; r < repeat[k]; ++r) passes[k]();
      best[k] = std::min(best[k], (now() - start) / (static_cast<double>(repeat[k]) * states));
    }
  }
  return best;
}

}  // namespace arboc::cli

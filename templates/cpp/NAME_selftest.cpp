@banner@
//
// Compares @name@ with results that the reference engine recorded, and with finite differences along
// recorded motions.  Prints a line a function; exit status 1 if one disagrees.
#include <cmath>
#include <cstdio>

#include "@name@_raw.hpp"

namespace @name@_selftest {
namespace {

constexpr int kStates = @states@;

@recordings@
int failures = 0;

/// Largest difference relative to the largest expected entry.
double relative_error(const double* got, const double* expected, int n) {
  double error = 0, scale = 1e-300;
  for (int i = 0; i < n; ++i) {
    const double difference = std::fabs(got[i] - expected[i]);
    if (!(difference <= error)) error = difference;  // not-a-number stays
    if (std::fabs(expected[i]) > scale) scale = std::fabs(expected[i]);
  }
  return error / (scale > 1e-9 ? scale : 1e-9);
}

void report(const char* what, double error, double tolerance) {
  const bool good = error <= tolerance;
  if (!good) ++failures;
  std::printf("%-32s error %.1e  %s\n", what, error, good ? "ok" : "WRONG");
}

void worst(double& error, double candidate) {
  if (!(candidate <= error)) error = candidate;
}

int run() {
@checks@  return failures == 0 ? 0 : 1;
}

}  // namespace
}  // namespace @name@_selftest

int main() { return @name@_selftest::run(); }

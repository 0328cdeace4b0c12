@banner@
//
// Compares @name@ with results that the reference engine recorded, and with finite differences along
// recorded motions.  Prints a line a function; exit status 1 if one disagrees.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "@name@_raw.hpp"

namespace @name@_selftest {
namespace {

constexpr int kStates = @states@;

@recordings@
int failures = 0;

/// Largest difference relative to the largest expected entry.
template <std::size_t n>
double relative_error(const std::vector<double>& got, const double (&expected)[n]) {
  double error = 0, scale = 1e-9;
  for (std::size_t i = 0; i < n; ++i) {
    const double difference = std::fabs(got[i] - expected[i]);
    if (!(difference <= error)) error = difference;  // not-a-number stays
    if (std::fabs(expected[i]) > scale) scale = std::fabs(expected[i]);
  }
  return error / scale;
}

/// The weight of row (side 0) or column (side 1) i in projection k, within +-1 and of size 1/2 at
/// least: a step of splitmix64.
[[maybe_unused]] inline double weight(std::uint64_t k, std::uint64_t side, std::uint64_t i) {
  std::uint64_t z = (2 * (4 * i + k) + side + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  z ^= z >> 31;
  const double size = 0.5 + static_cast<double>(z >> 11) * 0x1p-54;
  return (z & 1) != 0 ? size : -size;
}

/// The same of a matrix Y, given by rows, of which l^T Y r for four pairs of weights is recorded:
/// relative to the largest of these, which is about the root of the sum of the squares of the
/// entries.  No entry counts for less than a quarter; if Y is symmetric `side` is 0, r = l.
template <class Values>
double error_of_projections(const Values& got, std::size_t cols, std::uint64_t side,
                            const double (&expected)[4]) {
  double error = 0, scale = 1e-9;
  for (std::uint64_t k = 0; k < 4; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < got.size(); ++i)
      sum += weight(k, 0, i / cols) * weight(k, side, i % cols) * got[i];
    const double difference = std::fabs(sum - expected[k]);
    if (!(difference <= error)) error = difference;
    if (std::fabs(expected[k]) > scale) scale = std::fabs(expected[k]);
  }
  return error / scale;
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

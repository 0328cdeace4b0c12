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

/// The weight of entry i in sum k, within +-1: a step of splitmix64.
[[maybe_unused]] inline double weight(std::uint64_t k, std::uint64_t i) {
  std::uint64_t z = (2 * i + k + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

/// The same where of the entries y only w y / sqrt(n), for two vectors of weights, and the largest
/// one are recorded.
template <class Values>
double error_of_sums(const Values& got, const double (&expected)[3]) {
  double error = 0;
  for (std::uint64_t k = 0; k < 2; ++k) {
    double sum = 0;
    for (std::size_t i = 0; i < got.size(); ++i) sum += weight(k, i) * got[i];
    const double difference =
        std::fabs(sum / std::sqrt(static_cast<double>(got.size())) - expected[k]);
    if (!(difference <= error)) error = difference;
  }
  return error / (expected[2] > 1e-9 ? expected[2] : 1e-9);
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

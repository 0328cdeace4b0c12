#include "support/random.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace arboc::test {

double Random::uniform(double low, double high) {
  return low + (high - low) * std::ldexp(static_cast<double>(engine_() >> 11), -53);
}

int Random::integer(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

Eigen::VectorXd Random::vector(int n, double bound) {
  return Eigen::VectorXd::NullaryExpr(n, [&](Eigen::Index) { return uniform(-bound, bound); });
}

Eigen::VectorXd Random::direction(int n) {
  for (;;) {
    const Eigen::VectorXd inside = vector(n, 1);
    const double length = inside.norm();
    if (length > 0.1 && length < 1) return inside / length;
  }
}

std::vector<std::uint64_t> seeds(int n) {
  if (const char* text = std::getenv("ARBOC_SEED")) return {std::strtoull(text, nullptr, 10)};
  const char* factor = std::getenv("ARBOC_TEST_STATES");
  const auto times = factor ? std::max(1ul, std::strtoul(factor, nullptr, 10)) : 1ul;
  std::vector<std::uint64_t> result(static_cast<size_t>(n) * times);
  std::iota(result.begin(), result.end(), 1);
  return result;
}

}  // namespace arboc::test

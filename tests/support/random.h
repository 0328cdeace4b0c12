// Random numbers that are the same on every machine and in every standard library.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <vector>

namespace arboc::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high);
  /// 0 .. n-1.
  int integer(int n);
  bool chance(double probability) { return uniform(0, 1) < probability; }
  Eigen::VectorXd vector(int n, double bound);
  /// Uniform on the unit sphere of n dimensions.
  Eigen::VectorXd direction(int n);

 private:
  std::mt19937_64 engine_;
};

/// The seeds a property is tried with: 1 .. n (times the environment variable ARBOC_TEST_STATES),
/// or the one in ARBOC_SEED.
std::vector<std::uint64_t> seeds(int n);

}  // namespace arboc::test

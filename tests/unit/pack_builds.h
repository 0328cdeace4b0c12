// arboc/pack.hpp and arboc/rows.hpp as users compile them: for the machine at hand, with fused
// multiply-adds that the compiler may form at will, and for any machine.
#pragma once
#include <vector>

namespace arboc::test {

/// Each function takes values one behind the other, as many as a multiple of 16, and evaluates them
/// in packs of so many lanes.
template <class S>
struct PackFunctions {
  using Values = std::vector<S>;
  void (*sincos)(int lanes, const Values& x, Values& sine, Values& cosine);
  /// stumpff<0> to <5>, one behind the other.
  void (*stumpff)(int lanes, const Values& x, Values& y);
  /// quaternion_log and log_curvature, one behind the other.
  void (*logarithm)(int lanes, const Values& w, Values& y);
  /// x + 2 y, x - y / 3, -x y, sqrt|x|, x < y ? x : y, is any x < -1, one behind the other.
  void (*arithmetic)(int lanes, const Values& x, const Values& y, Values& z);
  /// Rows of `stride` of which `entries` are loaded and stored.
  void (*copy)(int lanes, const Values& from, int entries, int stride, Values& to);
  /// Of columns of `n` values: a lane's status, and `values` with nan where it is not 0.
  void (*checked)(int lanes, const Values& columns, int n, std::vector<int>& status,
                  Values& values);
};

struct PackBuild {
  const char* name;
  PackFunctions<double> of_double;
  PackFunctions<float> of_float;
};

extern const PackBuild kPackNative, kPackPlain;

}  // namespace arboc::test

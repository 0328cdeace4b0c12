// Every build and width of packs of S.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "support/random.h"
#include "unit/pack_builds.h"

namespace arboc::test {

template <class S>
struct PackCase {
  const PackBuild* build;
  int lanes;

  const PackFunctions<S>& functions() const {
    if constexpr (std::is_same_v<S, double>)
      return build->of_double;
    else
      return build->of_float;
  }
};

template <class S>
std::vector<PackCase<S>> pack_cases() {
  std::vector<PackCase<S>> cases;
  for (const PackBuild* build : {&kPackNative, &kPackPlain})
    for (const int lanes : {2, 4, 8, 16}) cases.push_back({build, lanes});
  return cases;
}

template <class S>
std::string case_name(const testing::TestParamInfo<PackCase<S>>& at) {
  return at.param.build->name + std::to_string(at.param.lanes);
}

/// Fills up with zeros to a multiple of 16.
template <class S>
void fill_up(std::vector<S>& x) {
  while (x.size() % 16 != 0) x.push_back(0);
}

/// Error of `got` in units of the last place (of S) of `exact`.
template <class S>
double ulps(S got, long double exact) {
  using Limits = std::numeric_limits<S>;
  int exponent = 0;
  std::frexp(static_cast<double>(exact), &exponent);
  const long double ulp =
      std::ldexp(1.0L, std::max(exponent - Limits::digits, Limits::min_exponent - Limits::digits));
  return static_cast<double>(std::fabs(static_cast<long double>(got) - exact) / ulp);
}

}  // namespace arboc::test

// What the algorithms ask of a scalar beyond + - * /, for double.
#pragma once
#include <cmath>

namespace arboc {

inline void sincos(const double& x, double& s, double& c) {
#ifdef __GLIBC__
  ::sincos(x, &s, &c);
#else
  s = std::sin(x);
  c = std::cos(x);
#endif
}

}  // namespace arboc

// Compiled with the flags of the other tests.  In a namespace of its own: two
// builds of one inline function would be merged by the linker.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "unit/sincos_builds.h"

namespace build_plain {
#include "arboc/scalar.hpp"
}  // namespace build_plain

namespace arboc::test {

void sincos_plain(double x, double& sine, double& cosine) {
  build_plain::arboc::sincos(x, sine, cosine);
}

}  // namespace arboc::test

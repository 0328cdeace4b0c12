// Compiled with -mfma -ffp-contract=fast where the compiler has them (CMakeLists.txt).  In a
// namespace of its own: two builds of one inline function would be merged by the linker.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "unit/sincos_builds.h"

namespace build_fused {
#include "arboc/scalar.hpp"
}  // namespace build_fused

namespace arboc::test {

void sincos_fused(double x, double& sine, double& cosine) {
  build_fused::arboc::sincos(x, sine, cosine);
}

}  // namespace arboc::test

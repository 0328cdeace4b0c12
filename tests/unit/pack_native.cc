// Compiled with -march=native -ffp-contract=fast where the compiler has them (CMakeLists.txt).
#define ARBOC_BUILD pack_native
#include "unit/pack_build.inl"

namespace arboc::test {
const PackBuild kPackNative{"Native", pack_native::Choice<double>::functions(),
                            pack_native::Choice<float>::functions()};
}  // namespace arboc::test

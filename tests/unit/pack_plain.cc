// Compiled with the flags of the other tests.
#define ARBOC_BUILD pack_plain
#include "unit/pack_build.inl"

namespace arboc::test {
const PackBuild kPackPlain{"Plain", pack_plain::Choice<double>::functions(),
                           pack_plain::Choice<float>::functions()};
}  // namespace arboc::test

// libFuzzer's entry.
#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  arboc::fuzz::compile(data, size);
  return 0;
}

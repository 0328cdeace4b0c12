// What the C++ compiler needs for each function.
#pragma once
#include "cli/common.h"

namespace arboc::cli {

/// arboc bench --compile: CPU seconds, memory and size of the object, a line a function.
int run_bench_compile(const Common& common);

}  // namespace arboc::cli

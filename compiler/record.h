// Results of the reference engine at a few random states, for the selftest of generated code.
#pragma once
#include "compile.h"

namespace arboc {

/// Fills in target.recordings; `functions` are those of the target, in its order.
void record(const Setup& setup, const std::vector<CompiledFunction>& functions,
            TargetModel& target);

}  // namespace arboc

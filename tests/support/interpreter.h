// Runs a Program statement by statement, as the emitted code would: locals live within their chunk
// only, everything else goes through the slots of the work array.
#pragma once
#include <vector>

#include "program/program.h"

namespace arboc::test {

/// One vector an output port.  Products inside sums are fused as evaluate() does it.  Throws
/// std::logic_error where a statement reads a local, slot or input that is not there, defines a
/// local twice, or an output entry is stored twice or never.
std::vector<std::vector<double>> interpret(const Program& program,
                                           const std::vector<std::vector<double>>& inputs);

}  // namespace arboc::test

// What the generic engine does: the same algorithms on a number that counts.
#pragma once
#include <string>

#include "functions/setup.h"

namespace arboc::test {

/// Multiplications, additions, divisions and roots of one call of the function's algorithm, a
/// product and the addition behind it as two; 0 where a function has no algorithm of its own.
int generic_operations(const Model& model, const std::string& function);

}  // namespace arboc::test

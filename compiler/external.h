// A request -> its function of the C interface, and the Jacobian of that.
#pragma once
#include <vector>

#include "emit/target.h"
#include "functions/trace.h"

namespace arboc {

/// The function with every output as CasADi has matrices: whole, by columns; and, of one that is no
/// derivative itself, its Jacobian: outputs dY_dX for each output Y (outer) and input X (inner),
/// rows the entries of Y by columns, inputs those of the function and its outputs.
///
/// The Jacobian is that of the expressions by the numbers that they are given: of a quaternion by
/// its four entries, not along the turns of the body as in --jacobian.
std::vector<ExternalFunction> external_functions(const Request& request, const Setup& setup);

}  // namespace arboc

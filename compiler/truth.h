// What the reference engine says of any request.
#pragma once
#include "functions/trace.h"

namespace arboc {

/// Outputs of `request`, dense and row-major, by name.  First derivatives are complex steps, exact
/// up to rounding (of wrenches and parameters: six-point differences); second derivatives are
/// six-point differences of those, good for some 1e-11 of the largest first derivative.
Values evaluate_reference(const Request& request, const Setup& setup, const Values& inputs);

}  // namespace arboc

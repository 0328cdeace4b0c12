// What the reference engine says of any request.
#pragma once
#include "functions/trace.h"

namespace arboc {

/// Outputs of `request`, dense and row-major, by name.  First derivatives are complex steps, exact
/// up to rounding (of lengths and masses: six-point differences); second derivatives are
/// differences of those, exact along what acts with its square at most, v and wrenches, elsewhere
/// of six points and good for some 1e-11 of the largest first derivative.
Values evaluate_reference(const Request& request, const Setup& setup, const Values& inputs);

/// Of each output Y kProjections numbers l^T Y r, which depend on every entry: l and r are random,
/// of entries between 1/2 and 1 in size, so that no entry counts for less than a quarter; where Y
/// is symmetric r = l, so that the two places of an entry add up.  Of derivatives they are taken
/// along l and r, a few evaluations each, whatever the size of Y.
Values evaluate_projections(const Request& request, const Setup& setup, const Values& inputs);
inline constexpr unsigned kProjections = 4;

}  // namespace arboc

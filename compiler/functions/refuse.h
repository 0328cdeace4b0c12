// Functions that have no value on a model, whatever its configuration.
#pragma once
#include <string>
#include <vector>

#include "functions/setup.h"
#include "graph/expr.h"

namespace arboc {

/// Throws AbsentError if `pivots`, one an entry of v, has one that is never positive: names the
/// joint whose coordinate cannot be accelerated by a finite force.
void refuse_singular(const DynamicTree& tree, const std::vector<Expr>& pivots,
                     const std::string& function);
/// Functions of the centre of mass divide by the mass of what moves.
void refuse_massless(const DynamicTree& tree, const Setup& setup, const std::string& function);
/// Of a file without masses there is kinematics only.
void refuse_dynamics(const Model& model, const std::string& function);

}  // namespace arboc

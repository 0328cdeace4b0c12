// Shapes, units and meanings of arguments by their names.
#pragma once
#include <string>

#include "emit/target.h"
#include "functions/setup.h"

namespace arboc {

/// q v a tau q1 f_ext lambda
Argument input_argument(const std::string& name, const Setup& setup);
Argument parameter_argument(const Parameter& parameter);
Argument output_argument(const std::string& function, const std::string& name, const Setup& setup);

/// Entries of a small change of an argument: nv for configurations, otherwise its entries.
int tangent_size(const Argument& argument, const Setup& setup);

}  // namespace arboc

// The functions that arboc generates: their names, signatures, and the algorithm behind each.
//
// To add one: write the algorithm (algorithms/), add a row to the table in catalogue.cc, a line to
// docs/functions.md, and its truth to check (cli/).
#pragma once
#include <map>
#include <string>
#include <vector>

#include "emit/target.h"
#include "tree/dynamic_tree.h"
#include "tree/lower.h"

namespace arboc {

/// All names, in the order of the documentation.
std::vector<std::string> function_names();
bool is_function(const std::string& name);

/// Arguments with shapes and units for this body.
Signature signature(const std::string& function, const DynamicTree& tree);

/// Lowerings that leave the function's results alone; the one that traces to the fewest operations
/// is taken.
std::vector<LoweringOptions> lowerings(const std::string& function);

struct Traced {
  Graph graph;                    ///< one output port an output (of matrices the non-zeros), then
                                  ///< the values that must be positive
  std::vector<Pattern> patterns;  ///< per output; of dense ones empty
};

/// Runs the algorithm with T = Expr.  Throws InputError that names a joint if forward dynamics is
/// singular for every q.
Traced trace(const std::string& function, const DynamicTree& tree);

/// Inputs and outputs of one state, dense and row-major, by argument name.
using Values = std::map<std::string, std::vector<double>>;

/// The same algorithm with T = double (the generic engine).
Values evaluate_generic(const std::string& function, const DynamicTree& tree, const Values& inputs);

}  // namespace arboc

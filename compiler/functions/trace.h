// A request -> the graph of what it computes, and the same by numbers.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "functions/catalogue.h"

namespace arboc {

/// The model has not what a function needs: its inertia is singular, or it has no masses.
class AbsentError : public InputError {
 public:
  using InputError::InputError;
};

struct Traced {
  Graph graph;                    ///< one output port an output (of matrices the non-zeros), then
                                  ///< the values that must be positive
  std::vector<Pattern> patterns;  ///< per output; of dense ones empty
};

/// Runs the algorithm with T = Expr; derivatives are taken on the graph.  Throws InputError that
/// names a joint if forward dynamics is singular for every q (AbsentError).
Traced trace(const Request& request, const Setup& setup, const LoweringOptions& lowering);

/// Inputs and outputs of one state, dense and row-major, by argument name.
using Values = std::map<std::string, std::vector<double>>;

/// The same algorithm with T = double (the generic engine); derivatives on the graph by evaluating
/// that.
Values evaluate_generic(const Request& request, const Setup& setup, const LoweringOptions& lowering,
                        const Values& inputs);

}  // namespace arboc

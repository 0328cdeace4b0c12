// The dynamic tree with parameters in place of the model's numbers.
#pragma once
#include "functions/run.h"
#include "graph/expr.h"

namespace arboc {

/// Lowered as `nominal`, the tree of the model's own numbers, is; `inputs` holds the parameters.
DynamicTreeOf<Expr> symbolic_tree(const Setup& setup, const LoweringOptions& lowering,
                                  const DynamicTree& nominal, const Arguments<Expr>& inputs);

}  // namespace arboc

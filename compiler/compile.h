// The recipe: a model and options in, the target of an emitter out.
#pragma once
#include <string>
#include <vector>

#include "emit/target.h"
#include "functions/catalogue.h"
#include "model/model.h"
#include "tree/dynamic_tree.h"

namespace arboc {

struct CompileOptions {
  ModelOptions model;
  std::vector<std::string> functions;  ///< names of the catalogue, in the order of emission
  std::vector<std::string> frames;     ///< links that fk reports; empty: each that a joint moves
  int max_dof = 512;                   ///< refuse larger models
};

/// One function on its way: what each stage made of it.
struct CompiledFunction {
  Signature signature;
  LoweringOptions lowering;  ///< the one with the fewest operations
  DynamicTree tree;
  Graph graph;  ///< after the passes
  std::vector<Pattern> patterns;
  Program program;
};

/// Traces `function` over each of its lowerings and keeps the smallest program.
CompiledFunction compile_function(const std::string& function, const Model& model);

/// Refuses what cannot be traced: no degrees of freedom, or more than max_dof.
void check_size(const Model& model, int max_dof);

/// Indices of the links whose frames are reported: those of `frames` in this order, or if there are
/// none, each that a joint moves, in the order of the joints.  `model` is configured.  Throws
/// UsageError for an unknown or repeated name.
std::vector<int> reported_links(const Model& model, const std::vector<std::string>& frames);

struct Compilation {
  Model model;  ///< configured
  std::vector<CompiledFunction> functions;
};

/// Runs every stage up to Program.  Notes and warnings go to `diagnostics`.
Compilation compile(const Model& model, const CompileOptions& options, Diagnostics& diagnostics);

/// What the emitter needs; the recordings of the selftest come from the reference engine.
TargetModel target(const Compilation& compilation, const CompileOptions& options);

}  // namespace arboc

// The recipe: a model and options in, the target of an emitter out.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "emit/target.h"
#include "functions/trace.h"
#include "model/model.h"

namespace arboc {

/// Languages to emit.
struct Targets {
  bool cpp = true;
  bool c = false;
};

struct CompileOptions {
  ModelOptions model;
  FunctionOptions function;
  std::vector<Request> requests;  ///< in the order of emission
  Targets targets;
  std::vector<Scalar> scalars{Scalar{}};  ///< double among them
  int max_dof = 512;                      ///< refuse larger models
  /// Functions that the model cannot have are left out with a warning, unless these are all.
  bool leave_out_absent = false;
};

/// The same function with isomorphic limbs in lanes.
struct CompiledLanes {
  LoweringOptions lowering;
  Graph graph;  ///< after the passes
  Program program;
};

/// One function on its way: what each stage made of it.
struct CompiledFunction {
  Request request;
  Signature signature;
  LoweringOptions lowering;  ///< the one with the fewest operations
  Graph graph;               ///< after the passes
  std::vector<Pattern> patterns;
  Program program;
  std::optional<CompiledLanes> lanes;  ///< where cheaper
};

/// Traces what is asked for over each of its lowerings and keeps the smallest program, and the
/// smallest with limbs in lanes if that is smaller.
CompiledFunction compile_function(const Request& request, const Setup& setup);

/// Warns that a function which the model cannot have is left out.
void report_left_out(const Request& request, const AbsentError& why, Diagnostics& diagnostics);

/// Refuses what cannot be traced: no degrees of freedom, or more than max_dof.
void check_size(const Model& model, int max_dof);

struct Compilation {
  Setup setup;
  std::vector<CompiledFunction> functions;
};

/// Runs every stage up to Program.  Notes and warnings go to `diagnostics`.
Compilation compile(const Model& model, const CompileOptions& options, Diagnostics& diagnostics);

/// Those that differ from their defaults, as on the command line, sorted.
std::vector<std::string> changed_options(const CompileOptions& options);

/// What the emitter needs; the recordings of the selftest come from the reference engine.
TargetModel target(const Compilation& compilation, const CompileOptions& options);

}  // namespace arboc

#include "compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "functions/lane_trace.h"
#include "passes/passes.h"

namespace arboc {
namespace {

/// trace(); a complaint begins with the file that it is about.
Traced trace_of(const Request& request, const Setup& setup, const LoweringOptions& lowering) {
  try {
    return trace(request, setup, lowering);
  } catch (const AbsentError& e) {
    throw AbsentError(fmt::format("{}: {}", printable(setup.model.file), e.what()));
  }
}

/// Hands over the function with limbs in lanes, as it is traced over each of its lowerings.
template <class Offer>
void offer_lanes(const Request& request, const Setup& setup, const CompiledFunction& f,
                 const Offer& offer) {
  const LoweringOptions plain = f.lowering;
  for (LoweringOptions lowering : lowerings(request.function)) {
    lowering.regroup = lowering.regroup && setup.simplify.regroup;
    if (!setup.simplify.frames && lowering.frames != plain.frames) continue;
    std::optional<Graph> traced = trace_in_lanes(request, setup, lowering, f.patterns);
    if (traced)
      offer(lowering, run_passes(std::move(*traced), {setup.simplify.dead, setup.simplify.fuse}));
  }
}

/// Keeps the cheapest program in lanes if it is cheaper than the plain one.
void put_in_lanes(const Request& request, const Setup& setup, CompiledFunction& f) {
  int least = f.program.ops.cost();
  offer_lanes(request, setup, f, [&](const LoweringOptions& lowering, Graph graph) {
    Program program = schedule(graph, {setup.max_function_size});
    if (program.ops.cost() >= least) return;
    least = program.ops.cost();
    f.lanes = {lowering, std::move(graph), std::move(program)};
  });
}

/// Keeps the shortest text in which limbs share functions if it is shorter than the plain one.
void share_limbs(const Request& request, const Setup& setup, CompiledFunction& f) {
  int least = count_listed(f.program).total();
  offer_lanes(request, setup, f, [&](const LoweringOptions& lowering, Graph graph) {
    Program program = schedule(graph, {setup.max_function_size, true});
    const int listed = count_listed(program).total();
    if (listed >= least) return;
    least = listed;
    f.lowering = lowering;
    f.graph = std::move(graph);
    f.program = std::move(program);
  });
}

/// Products and quotients of the model's numbers that no double holds.
void refuse_overflow(const Graph& graph, const Request& request, const Setup& setup) {
  const Region& region = graph.regions.back();
  for (const Node& node : region.nodes) {
    if (node.op != Op::kConstant) continue;
    const auto first = region.constants.begin() + node.index;
    if (std::all_of(first, first + node.count, [](double x) { return std::isfinite(x); })) continue;
    const std::string& block = region.blocks[node.block];
    throw InputError(fmt::format(
        "{}: error: {}: numbers of the model leave the range of double{} (check the units: m, kg, "
        "kg m^2)",
        printable(setup.model.file), name(request),
        block.empty() ? "" : " at " + printable(block)));
  }
}

}  // namespace

CompiledFunction compile_function(const Request& request, const Setup& setup) {
  CompiledFunction best;
  const Signature asked = signature(request, setup);
  bool first = true;
  for (LoweringOptions lowering : lowerings(request.function)) {
    if (!first && !setup.simplify.frames) break;
    lowering.regroup = lowering.regroup && setup.simplify.regroup;
    Traced traced = trace_of(request, setup, lowering);
    refuse_overflow(traced.graph, request, setup);
    Graph graph = run_passes(std::move(traced.graph), {setup.simplify.dead, setup.simplify.fuse});
    Program program = schedule(graph, {setup.max_function_size});
    if (!first && program.ops.total() >= best.program.ops.total()) continue;
    first = false;
    best = {
        request, asked, lowering, std::move(graph), std::move(traced.patterns), std::move(program),
        {}};
  }
  if (!setup.simplify.limbs) return best;
  (setup.optimise == Optimise::kSize ? share_limbs : put_in_lanes)(request, setup, best);
  return best;
}

void check_size(const Model& model, int max_dof) {
  const int nv = coordinates(model).nv;
  if (nv == 0)
    throw InputError(
        fmt::format("{}: error: no joint moves, so there is nothing to compile", model.file));
  if (nv > max_dof)
    throw InputError(fmt::format(
        "{}: error: {} degrees of freedom, more than the limit of {} (--max-dof {} allows it)",
        model.file, nv, max_dof, nv));
}

namespace {

/// Forces that are asked for and that no joint has.
void warn_of_absent_forces(const Setup& setup, Diagnostics& diagnostics) {
  const auto look = [&](bool asked, const char* name, double Joint::*value) {
    if (!asked || std::any_of(setup.model.joints.begin(), setup.model.joints.end(),
                              [&](const Joint& joint) { return joint.*value != 0; }))
      return;
    diagnostics.report({Severity::kWarning,
                        setup.model.file,
                        {},
                        "",
                        fmt::format("--joint-forces {}: no joint of the model has any", name),
                        ""});
  };
  look(setup.joint_forces.damping, "damping", &Joint::damping);
  look(setup.joint_forces.friction, "friction", &Joint::friction);
  look(setup.joint_forces.stiffness, "stiffness", &Joint::stiffness);
  look(setup.joint_forces.rotor, "rotor", &Joint::rotor_inertia);
}

}  // namespace

void report_left_out(const Request& request, const AbsentError& why, Diagnostics& diagnostics) {
  std::string text = why.what();  // FILE: error: ...
  const std::string mark = ": error: ";
  const size_t at = text.find(mark);
  diagnostics.report({Severity::kWarning,
                      text.substr(0, at),
                      {},
                      name(request),
                      "left out: " + text.substr(at + mark.size()),
                      ""});
}

Compilation compile(const Model& model, const CompileOptions& options, Diagnostics& diagnostics) {
  Compilation result{resolve(configure(model, options.model, diagnostics), options.function), {}};
  check_size(result.setup.model, options.max_dof);
  warn_of_absent_forces(result.setup, diagnostics);
  for (const Request& request : options.requests) {
    try {
      result.functions.push_back(compile_function(request, result.setup));
    } catch (const AbsentError& e) {
      if (!options.leave_out_absent ||
          (&request == &options.requests.back() && result.functions.empty()))
        throw;
      report_left_out(request, e, diagnostics);
    }
  }
  return result;
}

}  // namespace arboc

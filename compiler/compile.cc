#include "compile.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/number.h"
#include "emit/names.h"
#include "model/findings.h"
#include "model/names.h"
#include "passes/passes.h"
#include "record.h"

namespace arboc {
namespace {

/// trace(); a complaint begins with the file that it is about.
Traced trace_of(const Model& model, const std::string& function, const DynamicTree& tree) {
  try {
    return trace(function, tree);
  } catch (const InputError& e) {
    throw InputError(fmt::format("{}: {}", printable(model.file), e.what()));
  }
}

}  // namespace

CompiledFunction compile_function(const std::string& function, const Model& model) {
  CompiledFunction best;
  bool first = true;
  for (const LoweringOptions& lowering : lowerings(function)) {
    DynamicTree tree = lower(model, lowering);
    Traced traced = trace_of(model, function, tree);
    Graph graph = run_passes(std::move(traced.graph));
    Program program = schedule(graph);
    if (!first && program.ops.total() >= best.program.ops.total()) continue;
    first = false;
    best = {signature(function, tree),  lowering,          std::move(tree), std::move(graph),
            std::move(traced.patterns), std::move(program)};
  }
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

std::vector<int> reported_links(const Model& model, const std::vector<std::string>& frames) {
  std::vector<int> links;
  if (frames.empty())
    for (const Joint& joint : model.joints)
      if (nv(joint.type) > 0) links.push_back(joint.child);
  for (const std::string& frame : frames) {
    const int link = link_called(model, frame, "--frames");
    if (std::find(links.begin(), links.end(), link) != links.end())
      throw UsageError(fmt::format("--frames: {} is given twice", named("link", frame)));
    links.push_back(link);
  }
  return links;
}

Compilation compile(const Model& model, const CompileOptions& options, Diagnostics& diagnostics) {
  Compilation result{configure(model, options.model, diagnostics), {}};
  reported_links(result.model, options.frames);  // refuses unknown ones
  check_size(result.model, options.max_dof);
  for (const std::string& function : options.functions)
    result.functions.push_back(compile_function(function, result.model));
  return result;
}

namespace {

std::string text(const Lock& lock) {
  std::string values;
  for (const double x : lock.q) values += (values.empty() ? "" : ",") + shortest(x);
  return lock.joint + "=" + values;
}

std::vector<std::string> changed_options(const CompileOptions& compile_options) {
  const ModelOptions& options = compile_options.model;
  std::vector<std::string> changed;
  if (options.base == Base::kFloating) changed.emplace_back("--base floating");
  if (options.order == JointOrder::kAlphabetical)
    changed.emplace_back("--joint-order alphabetical");
  if (options.mimic == MimicPolicy::kIndependent) changed.emplace_back("--mimic independent");
  if (options.snap != ModelOptions().snap) changed.push_back("--snap " + shortest(options.snap));
  for (const Lock& lock : options.locks) changed.push_back("--lock " + text(lock));
  if (!options.root.empty()) changed.push_back("--root " + options.root);
  if (!options.tips.empty())
    changed.push_back(fmt::format("--tip {}", fmt::join(options.tips, ",")));
  if (!compile_options.frames.empty())
    changed.push_back(fmt::format("--frames {}", fmt::join(compile_options.frames, ",")));
  return changed;
}

/// Suffixes of a joint's coordinates in velocity_names.
std::vector<std::string> freedoms_of(JointType type) {
  switch (type) {
    case JointType::kFixed: return {};
    case JointType::kPlanar: return {".x", ".y", ".rz"};
    case JointType::kFloating: return {".x", ".y", ".z", ".rx", ".ry", ".rz"};
    default: return {""};
  }
}

void describe_joints(const Model& model, TargetModel& target) {
  const Coordinates at = coordinates(model);
  target.nq = at.nq;
  target.nv = at.nv;
  Table lower{"q_lower", std::vector<double>(static_cast<size_t>(at.nq), -Limits::kNone)};
  Table upper{"q_upper", std::vector<double>(static_cast<size_t>(at.nq), Limits::kNone)};
  Table velocity{"v_limit", std::vector<double>(static_cast<size_t>(at.nv), Limits::kNone)};
  Table effort{"tau_limit", std::vector<double>(static_cast<size_t>(at.nv), Limits::kNone)};
  nlohmann::ordered_json joints = nlohmann::ordered_json::array();
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (nv(joint.type) == 0) continue;
    nlohmann::ordered_json row{{"name", joint.name},   {"type", name(joint.type)},
                               {"q", at.joint[k].q},   {"v", at.joint[k].v},
                               {"nq", nq(joint.type)}, {"nv", nv(joint.type)}};
    if (joint.mimic) {
      row["mimic"] = {{"multiplier", at.joint[k].multiplier}, {"offset", at.joint[k].offset}};
    } else {
      target.joint_names.push_back(joint.name);
      for (const std::string& suffix : freedoms_of(joint.type))
        target.velocity_names.push_back(joint.name + suffix);
    }
    if (!joint.mimic && nv(joint.type) == 1) {
      lower.values[static_cast<size_t>(at.joint[k].q)] = joint.limits.lower;
      upper.values[static_cast<size_t>(at.joint[k].q)] = joint.limits.upper;
      velocity.values[static_cast<size_t>(at.joint[k].v)] = joint.limits.velocity;
      effort.values[static_cast<size_t>(at.joint[k].v)] = joint.limits.effort;
    }
    row["damping"] = joint.damping;
    row["friction"] = joint.friction;
    joints.push_back(row);
  }
  target.limits = {lower, upper, velocity, effort};
  target.manifest_extra = nlohmann::ordered_json{{"joints", joints}}.dump();
}

}  // namespace

TargetModel target(const Compilation& compilation, const CompileOptions& options) {
  const Model& model = compilation.model;
  TargetModel target;
  target.name = identifier(model.name);
  target.source_file = model.file;
  target.source_sha256 = model.source_sha256;
  target.options = changed_options(options);
  describe_joints(model, target);
  for (const CompiledFunction& f : compilation.functions) {
    target.functions.push_back({f.signature, f.patterns, f.program});
    if (f.signature.name != "fk") continue;
    for (const FrameOf<double>& frame : f.tree.frame)
      if (frame.moving) target.frame_names.push_back(frame.name);
  }
  record(model, target);
  return target;
}

}  // namespace arboc

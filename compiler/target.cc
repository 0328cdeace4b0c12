// What the emitter needs to know of a compilation.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/number.h"
#include "compile.h"
#include "emit/names.h"
#include "external.h"
#include "functions/lane_trace.h"
#include "record.h"

namespace arboc {
namespace {

/// The groups of limbs in lanes, in one line.
std::string limbs_text(const Setup& setup, const CompiledLanes& lanes) {
  const DynamicTree tree = lower(setup, lanes.lowering);
  std::vector<std::string> groups;
  for (const LimbGroup& group : limbs_in_lanes(setup, lanes.lowering)) {
    std::vector<std::string> roots;
    for (const auto& limb : group.limb)
      roots.push_back(tree.body[static_cast<size_t>(limb[0])].link);
    groups.push_back(fmt::format("{} ({} joints each)", fmt::join(roots, ", "), group.parts()));
  }
  return fmt::format("Limbs in lanes: {}.", fmt::join(groups, "; "));
}

std::string text(const Lock& lock) {
  std::string values;
  for (const double x : lock.q) values += (values.empty() ? "" : ",") + shortest(x);
  return lock.joint + "=" + values;
}

const char* word(Axes axes) {
  return axes == Axes::kLocal ? "local" : axes == Axes::kWorld ? "world" : "aligned";
}

std::vector<std::string> words(const JointForces& forces) {
  std::vector<std::string> list;
  if (forces.damping) list.emplace_back("damping");
  if (forces.friction) list.emplace_back("friction");
  if (forces.stiffness) list.emplace_back("stiffness");
  if (forces.rotor) list.emplace_back("rotor");
  return list;
}

void add_changed(const FunctionOptions& options, std::vector<std::string>& changed) {
  const auto add = [&](const char* name, const std::vector<std::string>& words) {
    if (!words.empty()) changed.push_back(fmt::format("--{} {}", name, fmt::join(words, ",")));
  };
  add("frames", options.frames);
  if (options.axes != Axes::kLocal) changed.push_back(fmt::format("--axes {}", word(options.axes)));
  if (options.transform_order != FunctionOptions().transform_order)
    changed.push_back(fmt::format("--transform-order {}", options.transform_order));
  add("external-forces", options.external_forces);
  add("joint-forces", words(options.joint_forces));
  const double velocity = options.joint_forces.friction_velocity;
  if (velocity != JointForces().friction_velocity)
    changed.push_back("--friction-velocity " + shortest(velocity));
  add("parameters", options.parameters);
  std::vector<std::string> without;
  for (const auto& [name, member] : kSimplifications)
    if (!(options.simplify.*member)) without.emplace_back(name);
  add("without", without);
  if (options.max_function_size != FunctionOptions().max_function_size)
    changed.push_back(fmt::format("--max-function-size {}", options.max_function_size));
  if (options.optimise == Optimise::kSize) changed.emplace_back("--optimise size");
  if (options.iterated) changed.emplace_back("--iterated");
}

}  // namespace

std::vector<std::string> changed_options(const CompileOptions& compile_options) {
  const ModelOptions& options = compile_options.model;
  std::vector<std::string> changed;
  if (options.base == Base::kFloating) changed.emplace_back("--base floating");
  if (options.base == Base::kFixed) changed.emplace_back("--base fixed");
  if (options.order == JointOrder::kAlphabetical)
    changed.emplace_back("--joint-order alphabetical");
  if (options.mimic == MimicPolicy::kIndependent) changed.emplace_back("--mimic independent");
  if (options.continuous == ContinuousAs::kCosSin) changed.emplace_back("--continuous cos-sin");
  if (options.expand) changed.emplace_back("--expand");
  if (options.snap != ModelOptions().snap) changed.push_back("--snap " + shortest(options.snap));
  for (const Lock& lock : options.locks) changed.push_back("--lock " + text(lock));
  if (!options.root.empty()) changed.push_back("--root " + options.root);
  if (!options.hang_from.empty()) changed.push_back("--hang-from " + options.hang_from);
  if (!options.tips.empty())
    changed.push_back(fmt::format("--tip {}", fmt::join(options.tips, ",")));
  add_changed(compile_options.function, changed);
  if (compile_options.targets.c)
    changed.emplace_back(compile_options.targets.cpp ? "--target cpp,c" : "--target c");
  std::vector<std::string> scalars;
  for (const Scalar& scalar : compile_options.scalars)
    if (scalar.name != "double") scalars.push_back(scalar.name);
  if (!scalars.empty()) changed.push_back(fmt::format("--scalars {}", fmt::join(scalars, ",")));
  return changed;
}

namespace {

/// Suffixes of a joint's coordinates in velocity_names.
std::vector<std::string> freedoms_of(JointType type) {
  switch (type) {
    case JointType::kFixed: return {};
    case JointType::kPlanar: return {".x", ".y", ".rz"};
    case JointType::kFloating: return {".x", ".y", ".z", ".rx", ".ry", ".rz"};
    case JointType::kSpherical: return {".rx", ".ry", ".rz"};
    default: return {""};
  }
}

/// Springs, and the postures that the model file names, as tables.
void describe_postures(const Model& model, const Coordinates& at, TargetModel& target) {
  const auto add = [&](const std::string& name, const auto& value) {
    Table table{name, std::vector<double>(static_cast<size_t>(at.nq), 0.0)};
    for (size_t k = 0; k < model.joints.size(); ++k)
      if (!model.joints[k].mimic && nq(model.joints[k]) == 1)
        table.values[static_cast<size_t>(at.joint[k].q)] = value(model.joints[k]);
    target.limits.push_back(std::move(table));
  };
  if (std::any_of(model.joints.begin(), model.joints.end(),
                  [](const Joint& joint) { return joint.stiffness != 0; })) {
    add("q_neutral", [](const Joint& joint) { return joint.neutral; });
    add("stiffness", [](const Joint& joint) { return joint.stiffness; });
  }
  for (const Posture& posture : model.postures)
    add("q_" + identifier(posture.name), [&](const Joint& joint) {
      const auto found = std::find_if(posture.q.begin(), posture.q.end(),
                                      [&](const auto& q) { return q.first == joint.name; });
      return found == posture.q.end() ? 0.0 : found->second;
    });
}

void describe_joints(const Model& model, TargetModel& target) {
  const Coordinates at = coordinates(model);
  target.nq = at.nq;
  target.nv = at.nv;
  Table lower{"q_lower", std::vector<double>(static_cast<size_t>(at.nq), -Limits::kNone)};
  Table upper{"q_upper", std::vector<double>(static_cast<size_t>(at.nq), Limits::kNone)};
  Table velocity{"v_limit", std::vector<double>(static_cast<size_t>(at.nv), Limits::kNone)};
  Table tau_lower{"tau_lower", std::vector<double>(static_cast<size_t>(at.nv), -Limits::kNone)};
  Table tau_upper{"tau_upper", std::vector<double>(static_cast<size_t>(at.nv), Limits::kNone)};
  nlohmann::ordered_json joints = nlohmann::ordered_json::array();
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (nv(joint) == 0) continue;
    nlohmann::ordered_json row{{"name", joint.name}, {"type", name(joint.type)},
                               {"q", at.joint[k].q}, {"v", at.joint[k].v},
                               {"nq", nq(joint)},    {"nv", nv(joint)}};
    if (joint.mimic) {
      row["mimic"] = {{"multiplier", at.joint[k].multiplier}, {"offset", at.joint[k].offset}};
    } else {
      target.joint_names.push_back(joint.name);
      for (const std::string& suffix : freedoms_of(joint.type))
        target.velocity_names.push_back(joint.name + suffix);
    }
    if (!joint.mimic && nv(joint) == 1) {
      if (nq(joint) == 1) {
        lower.values[static_cast<size_t>(at.joint[k].q)] = joint.limits.lower;
        upper.values[static_cast<size_t>(at.joint[k].q)] = joint.limits.upper;
      }
      velocity.values[static_cast<size_t>(at.joint[k].v)] = joint.limits.velocity;
      tau_lower.values[static_cast<size_t>(at.joint[k].v)] = joint.limits.effort_lower;
      tau_upper.values[static_cast<size_t>(at.joint[k].v)] = joint.limits.effort;
    }
    row["damping"] = joint.damping;
    row["friction"] = joint.friction;
    if (joint.stiffness != 0) {
      row["stiffness"] = joint.stiffness;
      row["neutral"] = joint.neutral;
    }
    if (joint.rotor_inertia != 0) row["rotor"] = joint.rotor_inertia;
    joints.push_back(row);
  }
  target.limits = {lower, upper, velocity, tau_lower, tau_upper};
  describe_postures(model, at, target);
  target.manifest_extra = nlohmann::ordered_json{{"joints", joints}}.dump();
}

}  // namespace

TargetModel target(const Compilation& compilation, const CompileOptions& options) {
  const Setup& setup = compilation.setup;
  const Model& model = setup.model;
  TargetModel target;
  target.name = identifier(model.name);
  target.source_file = model.file;
  target.source_sha256 = model.source_sha256;
  target.options = changed_options(options);
  target.scalars = options.scalars;
  describe_joints(model, target);
  for (const CompiledFunction& f : compilation.functions) {
    target.functions.push_back({text(f.request), f.signature, f.patterns, f.program, {}});
    if (f.lanes) target.functions.back().lanes = {limbs_text(setup, *f.lanes), f.lanes->program};
  }
  target.cpp = options.targets.cpp;
  if (options.targets.c)
    for (const CompiledFunction& f : compilation.functions)
      for (ExternalFunction& e : external_functions(f.request, setup))
        target.externals.push_back(std::move(e));
  for (const int frame : setup.frames)
    target.frame_names.push_back(model.links[static_cast<size_t>(frame)].name);
  for (const int load : setup.loads)
    target.load_names.push_back(model.links[static_cast<size_t>(load)].name);
  for (const Parameter& p : setup.parameters)
    target.parameters.push_back({p.name, p.unit, p.meaning, p.labels, p.nominal});
  target.axes = word(setup.axes);
  target.joint_forces = words(setup.joint_forces);
  target.friction_velocity = setup.joint_forces.friction_velocity;
  record(setup, compilation.functions, target);
  return target;
}

}  // namespace arboc

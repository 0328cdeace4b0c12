// configure(): the model options, each a step of its own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/diagnostic.h"
#include "base/exact_trig.h"
#include "base/number.h"
#include "model/configure_steps.h"

namespace arboc {
namespace {

void note(const Model& model, Location where, std::string element, std::string message,
          std::string hint, Diagnostics& diagnostics) {
  diagnostics.report({Severity::kNote, model.file, where, std::move(element), std::move(message),
                      std::move(hint)});
}

void add_floating_root(Model& model) {
  const auto taken = [&](const std::string& name) {
    return std::any_of(model.joints.begin(), model.joints.end(),
                       [&](const Joint& j) { return j.name == name; });
  };
  Joint root;
  root.name = "root_joint";
  for (int n = 2; taken(root.name); ++n) root.name = fmt::format("root_joint_{}", n);
  root.type = JointType::kFloating;
  root.child = model.root;
  model.joints.push_back(root);
}

/// The items but those at `gone`, and in `renumbered` the new index of each old one, or -1.
template <class Item>
void erase(std::vector<Item>& items, const std::vector<char>& gone, std::vector<int>& renumbered) {
  std::vector<Item> rest;
  renumbered.assign(items.size(), -1);
  for (size_t k = 0; k < items.size(); ++k) {
    if (gone[k]) continue;
    renumbered[k] = static_cast<int>(rest.size());
    rest.push_back(std::move(items[k]));
  }
  items = std::move(rest);
}

/// One joint of the type in place of those by which the root moves freely; false if there are none.
bool join_free_root(Model& model, JointType type) {
  std::vector<char> gone_joint(model.joints.size()), gone_link(model.links.size());
  int first = -1;
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (!joint.free_root) continue;
    if (first < 0) {
      first = static_cast<int>(k);
      continue;
    }
    Joint& root = model.joints[static_cast<size_t>(first)];
    if (root.child != joint.parent)
      throw UsageError("--base: one of the coordinates of the root is locked");
    gone_link[static_cast<size_t>(joint.parent)] = gone_joint[k] = true;
    root.child = joint.child;
  }
  if (first < 0) return false;
  Joint root;
  root.name = "root_joint";
  root.type = type;
  root.parent = model.joints[static_cast<size_t>(first)].parent;
  root.child = model.joints[static_cast<size_t>(first)].child;
  root.location = model.joints[static_cast<size_t>(first)].location;
  model.joints[static_cast<size_t>(first)] = root;
  std::vector<int> new_link, new_joint;
  erase(model.links, gone_link, new_link);
  erase(model.joints, gone_joint, new_joint);
  model.root = new_link[static_cast<size_t>(model.root)];
  for (Joint& joint : model.joints) {
    if (joint.parent >= 0) joint.parent = new_link[static_cast<size_t>(joint.parent)];
    joint.child = new_link[static_cast<size_t>(joint.child)];
    if (joint.mimic) joint.mimic->leader = new_joint[static_cast<size_t>(joint.mimic->leader)];
  }
  return true;
}

void attach_root(Model& model, Base base) {
  if (base == Base::kFile) return;
  const bool floats = base == Base::kFloating;
  const bool was_free = join_free_root(model, floats ? JointType::kFloating : JointType::kFixed);
  if (!was_free && floats) add_floating_root(model);
}

/// Snaps the angles of `pose`; says what changed, and what a coarser tolerance would change.
void snap_pose(const Model& model, Pose& pose, const std::string& element, Location where,
               double tolerance, Diagnostics& diagnostics) {
  constexpr double kCoarsest = 1e-3;  // 1.57 for pi/2 is 8e-4 off
  for (int i = 0; i < 3; ++i) {
    double& angle = pose.rpy[i];
    const auto k = multiple_of_15_degrees(angle, std::max(tolerance, kCoarsest));
    if (!k || angle == degrees15(*k)) continue;
    const double error = std::fabs(angle - degrees15(*k));
    if (error <= 4 * std::numeric_limits<double>::epsilon() * std::fabs(angle))
      continue;  // exact already
    if (error <= tolerance) {
      note(model, where, element,
           fmt::format("angle {} taken as {} degrees", shortest(angle), 15 * *k),
           "--snap 0 keeps it", diagnostics);
      angle = degrees15(*k);
    } else {
      const double wanted = std::pow(10.0, std::ceil(std::log10(error)));
      note(model, where, element,
           fmt::format("angle {} is {:.1e} rad from {} degrees; as written it costs operations in "
                       "every function",
                       shortest(angle), error, 15 * *k),
           fmt::format("write more digits, or --snap {} takes it as {} degrees", shortest(wanted),
                       15 * *k),
           diagnostics);
    }
  }
}

void snap_axis(const Model& model, const Joint& joint, Vector3<double>& axis, double tolerance,
               Diagnostics& diagnostics) {
  for (int i = 0; i < 3; ++i) {
    double& x = axis[i];
    for (const long k : {-6L, -5L, -4L, -3L, -2L, -1L, 0L, 1L, 2L, 3L, 4L, 5L, 6L}) {
      const double sine = exact_sincos(degrees15(k)).sin;
      const double error = std::fabs(x - sine);
      if (error == 0 || error > tolerance) continue;
      if (error > 4 * std::numeric_limits<double>::epsilon())
        note(model, joint.location, fmt::format("joint '{}'", joint.name),
             fmt::format("<axis>: component {} taken as {}", shortest(x), shortest(sine)),
             "--snap 0 keeps it", diagnostics);
      x = sine;
    }
  }
}

void snap(Model& model, double tolerance, Diagnostics& diagnostics) {
  for (Joint& joint : model.joints) {
    const std::string element = fmt::format("joint '{}'", joint.name);
    snap_pose(model, joint.origin, element, joint.location, tolerance, diagnostics);
    if (has_axis(joint.type)) snap_axis(model, joint, joint.axis, tolerance, diagnostics);
    for (JointAxis& a : joint.axes) snap_axis(model, joint, a.axis, tolerance, diagnostics);
  }
  for (Link& link : model.links) {
    if (link.inertial)
      snap_pose(model, link.inertial->origin, fmt::format("link '{}': <inertial>", link.name),
                link.location, tolerance, diagnostics);
  }
}

/// Joint indices depth first from the world, children in file order or by name.
std::vector<int> depth_first(const Model& model, JointOrder order) {
  std::vector<std::vector<int>> children(model.links.size() + 1);  // by parent link + 1
  for (size_t k = 0; k < model.joints.size(); ++k)
    children[static_cast<size_t>(model.joints[k].parent + 1)].push_back(static_cast<int>(k));
  const auto joint = [&](int k) -> const Joint& { return model.joints[static_cast<size_t>(k)]; };
  if (order == JointOrder::kAlphabetical)
    for (auto& list : children)
      std::sort(list.begin(), list.end(),
                [&](int a, int b) { return joint(a).name < joint(b).name; });

  std::vector<int> result, stack;
  const auto push = [&](size_t slot) {
    stack.insert(stack.end(), children[slot].rbegin(), children[slot].rend());
  };
  push(static_cast<size_t>(model.root + 1));
  push(0);
  while (!stack.empty()) {
    const int k = stack.back();
    stack.pop_back();
    result.push_back(k);
    if (joint(k).child != model.root) push(static_cast<size_t>(joint(k).child + 1));
  }
  return result;
}

/// Renumbers joints in `order` and links in the order in which they are reached.
void reorder(Model& model, const std::vector<int>& order) {
  std::vector<int> new_joint(model.joints.size(), -1), new_link(model.links.size(), -1);
  std::vector<int> old_link{model.root};
  for (size_t k = 0; k < order.size(); ++k) {
    new_joint[static_cast<size_t>(order[k])] = static_cast<int>(k);
    const int child = model.joints[static_cast<size_t>(order[k])].child;
    if (child != model.root) old_link.push_back(child);
  }
  for (size_t k = 0; k < old_link.size(); ++k)
    new_link[static_cast<size_t>(old_link[k])] = static_cast<int>(k);

  std::vector<Joint> joints;
  std::vector<Link> links;
  for (const int k : order) joints.push_back(std::move(model.joints[static_cast<size_t>(k)]));
  for (const int k : old_link) links.push_back(std::move(model.links[static_cast<size_t>(k)]));
  for (Joint& joint : joints) {
    if (joint.parent >= 0) joint.parent = new_link[static_cast<size_t>(joint.parent)];
    joint.child = new_link[static_cast<size_t>(joint.child)];
    if (joint.mimic) joint.mimic->leader = new_joint[static_cast<size_t>(joint.mimic->leader)];
  }
  model.joints = std::move(joints);
  model.links = std::move(links);
  model.root = 0;
}

}  // namespace

Model configure(Model model, const ModelOptions& options, Diagnostics& diagnostics) {
  if (!options.name.empty()) model.name = options.name;
  if (options.snap > 0) snap(model, options.snap, diagnostics);
  if (options.mimic == MimicPolicy::kIndependent)
    for (Joint& joint : model.joints) joint.mimic.reset();
  if (!options.locks.empty()) lock_joints(model, options.locks, diagnostics);
  if (!options.root.empty() || !options.tips.empty())
    keep_subchain(model, options.root, options.tips, diagnostics);
  if (!options.hang_from.empty()) {
    if (options.expand) expand_joints(model, diagnostics);
    reroot(model, options.hang_from);
  }
  attach_root(model, options.base);
  if (options.expand) expand_joints(model, diagnostics);
  if (options.continuous == ContinuousAs::kCosSin) unbind_continuous_joints(model, diagnostics);
  reorder(model, depth_first(model, options.order));
  split_joints(model);
  reorder(model, depth_first(model, JointOrder::kFile));
  return model;
}

}  // namespace arboc

// keep_subchain(): the part of a model between a root and tips.
#include <fmt/format.h>

#include <algorithm>

#include "base/number.h"
#include "model/configure_steps.h"
#include "model/findings.h"
#include "model/names.h"
#include "model/validate.h"

namespace arboc {
namespace {

size_t at(int index) { return static_cast<size_t>(index); }

/// Which links stay.
std::vector<char> kept_links(const Model& model, const std::vector<std::string>& tips) {
  std::vector<int> joint_of = joints_onto(model);
  joint_of[at(model.root)] = -1;
  const std::vector<int> subtree = outward(model, joint_of);
  std::vector<char> kept(model.links.size());
  if (tips.empty()) {
    for (const int k : subtree) kept[at(k)] = true;
    return kept;
  }
  std::vector<char> reached(model.links.size());
  for (const int k : subtree) reached[at(k)] = true;
  for (const std::string& tip : tips) {
    int k = link_called(model, tip, "--tip");
    if (!reached[at(k)])
      throw UsageError(printable(fmt::format("--tip: {} does not hang on {}", named("link", tip),
                                             named("link", model.links[at(model.root)].name))));
    for (; !kept[at(k)]; k = model.joints[at(joint_of[at(k)])].parent) {
      kept[at(k)] = true;
      if (k == model.root) break;
    }
  }
  for (const int k : subtree) {
    if (k == model.root) continue;
    const Joint& joint = model.joints[at(joint_of[at(k)])];
    if (joint.type == JointType::kFixed && kept[at(joint.parent)]) kept[at(k)] = true;
  }
  return kept;
}

void check_leaders(const Model& model, const std::vector<char>& stays) {
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (!stays[k] || !joint.mimic || stays[at(joint.mimic->leader)]) continue;
    throw InputError(
        to_string({Severity::kError, model.file, joint.mimic->location, named("joint", joint.name),
                   fmt::format("<mimic>: follows {}, which --root or --tip cuts off",
                               named("joint", model.joints[at(joint.mimic->leader)].name)),
                   "keep that one, hold it by --lock, or use --mimic independent"}));
  }
}

std::string count(size_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// Says how much of `model` does not stay.
void report_dropped(const Model& model, const std::vector<char>& kept_link,
                    const std::vector<char>& kept_joint, Diagnostics& diagnostics) {
  size_t links = 0, joints = 0, moving = 0;
  double mass = 0;
  for (size_t k = 0; k < model.links.size(); ++k) {
    if (kept_link[k]) continue;
    ++links;
    if (model.links[k].inertial) mass += model.links[k].inertial->mass;
  }
  for (size_t k = 0; k < model.joints.size(); ++k) {
    if (kept_joint[k]) continue;
    ++joints;
    if (nv(model.joints[k]) > 0) ++moving;
  }
  diagnostics.report({Severity::kNote,
                      model.file,
                      {},
                      named("link", model.links[at(model.root)].name),
                      fmt::format("subchain from here: left out are {} with {} kg, and {} of which "
                                  "{} move{}",
                                  count(links, "link"), shortest(mass), count(joints, "joint"),
                                  moving, moving == 1 ? "s" : ""),
                      ""});
}

/// The items that stay, and in `renumbered` the new index of each old one, or -1.
template <class Item>
void erase_others(std::vector<Item>& items, const std::vector<char>& stays,
                  std::vector<int>& renumbered) {
  std::vector<Item> rest;
  renumbered.assign(items.size(), -1);
  for (size_t k = 0; k < items.size(); ++k) {
    if (!stays[k]) continue;
    renumbered[k] = static_cast<int>(rest.size());
    rest.push_back(std::move(items[k]));
  }
  items = std::move(rest);
}

}  // namespace

void keep_subchain(Model& model, const std::string& root, const std::vector<std::string>& tips,
                   Diagnostics& diagnostics) {
  const int old_root = model.root;
  if (!root.empty()) model.root = link_called(model, root, "--root");
  const std::vector<char> kept_link = kept_links(model, tips);
  std::vector<char> kept_joint(model.joints.size());
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    const bool onto_root = joint.child == model.root;
    kept_joint[k] = kept_link[at(joint.child)] && (!onto_root || model.root == old_root);
  }
  check_leaders(model, kept_joint);
  report_dropped(model, kept_link, kept_joint, diagnostics);

  std::vector<int> new_link, new_joint;
  erase_others(model.links, kept_link, new_link);
  erase_others(model.joints, kept_joint, new_joint);
  model.root = new_link[at(model.root)];
  for (Joint& joint : model.joints) {
    if (joint.parent >= 0) joint.parent = new_link[at(joint.parent)];
    joint.child = new_link[at(joint.child)];
    if (joint.mimic) joint.mimic->leader = new_joint[at(joint.mimic->leader)];
  }
}

}  // namespace arboc

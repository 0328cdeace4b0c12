// Names, tree and mimic graph of a Model; masses are in mass_check.cc.
#include "model/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace arboc {
namespace {

size_t at(int index) { return static_cast<size_t>(index); }

const Link& link(const Model& model, int index) { return model.links[at(index)]; }
const Joint& joint(const Model& model, int index) { return model.joints[at(index)]; }

/// Reports links or joints whose name an earlier one has; nameless ones the front end has reported.
template <class Item>
bool names_are_unique(const std::vector<Item>& items, const char* kind, Findings& findings) {
  std::unordered_map<std::string_view, const Item*> first;
  bool unique = true;
  for (const Item& item : items) {
    if (item.name.empty()) {
      unique = false;
      continue;
    }
    const auto [known, is_new] = first.emplace(item.name, &item);
    if (is_new) continue;
    unique = false;
    findings.error({item.location, named(kind, item.name),
                    fmt::format("another {} has this name", kind),
                    fmt::format("the first one is in line {}", known->second->location.line)});
  }
  return unique;
}

bool is_resolved(const Model& model) {
  return std::all_of(model.joints.begin(), model.joints.end(),
                     [](const Joint& j) { return j.parent >= 0 && j.child >= 0; });
}

/// No joint from a link to itself, no second joint onto a link.
bool each_link_has_one_parent(const Model& model, const std::vector<int>& joint_of,
                              Findings& findings) {
  const int before = findings.error_count();
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& j = model.joints[k];
    const std::string& child = link(model, j.child).name;
    const int first = joint_of[at(j.child)];
    if (j.parent == j.child) {
      findings.error({j.location, named("joint", j.name),
                      fmt::format("parent and child are the same link {}", quoted(child))});
    } else if (at(first) != k) {
      findings.error({j.location, named("joint", j.name),
                      fmt::format("link {} is already the child of {}", quoted(child),
                                  named("joint", joint(model, first).name)),
                      "closed loops cannot be read: a link has one parent"});
    }
  }
  return findings.error_count() == before;
}

/// Reports each loop among the links that `reached` leaves out, at its last joint in the file.
void report_loops(const Model& model, const std::vector<int>& joint_of, std::vector<char> reached,
                  Findings& findings) {
  for (size_t start = 0; start < model.links.size(); ++start) {
    std::vector<int> path;
    int k = static_cast<int>(start);
    while (!reached[at(k)]) {
      reached[at(k)] = true;
      path.push_back(k);
      k = joint(model, joint_of[at(k)]).parent;
    }
    const auto begin = std::find(path.begin(), path.end(), k);
    if (begin == path.end()) continue;  // hangs on a loop or branch seen before
    int last = -1;
    std::string chain;
    for (auto it = path.end(); it != begin;) {
      const int member = *--it;
      last = std::max(last, joint_of[at(member)]);
      if (path.end() - it <= 4) chain += quoted(link(model, member).name) + " -> ";
    }
    if (path.end() - begin > 4) chain += "... -> ";
    findings.error(
        {joint(model, last).location, named("joint", joint(model, last).name),
         fmt::format("closes a loop of links: {}{}", chain, quoted(link(model, path.back()).name)),
         "a robot is a tree"});
  }
}

bool is_one_tree(Model& model, const std::vector<int>& joint_of, Findings& findings) {
  const int before = findings.error_count();
  std::vector<char> reached(model.links.size());
  for (size_t k = 0; k < model.links.size(); ++k) {
    if (joint_of[k] >= 0) continue;
    const Link& root = model.links[k];
    if (model.root >= 0)
      findings.error({root.location, named("link", root.name), "no joint leads to this link",
                      fmt::format("link {} has no parent either, and a robot has one root",
                                  quoted(link(model, model.root).name))});
    const int first_root = model.root >= 0 ? model.root : static_cast<int>(k);
    model.root = static_cast<int>(k);
    for (const int member : outward(model, joint_of)) reached[at(member)] = true;
    model.root = first_root;
  }
  report_loops(model, joint_of, std::move(reached), findings);
  return findings.error_count() == before;
}

bool one_coordinate(const Joint& j) { return nv(j) == 1; }

void check_mimic_ends(const Model& model, Findings& findings) {
  for (const Joint& j : model.joints) {
    if (!j.mimic) continue;
    if (!one_coordinate(j))
      findings.error({j.mimic->location, named("joint", j.name),
                      fmt::format("<mimic>: a {} joint cannot follow another", name(j.type)),
                      "only joints with one coordinate can"});
    if (j.mimic->leader < 0) continue;
    const Joint& leader = joint(model, j.mimic->leader);
    if (!one_coordinate(leader))
      findings.error({j.mimic->location, named("joint", j.name),
                      fmt::format("<mimic>: {} is {} and cannot lead", named("joint", leader.name),
                                  name(leader.type)),
                      "only joints with one coordinate can"});
  }
}

void check_mimic_cycles(const Model& model, Findings& findings) {
  std::vector<int> visit(model.joints.size(), -1);  // the walk that came by
  for (size_t start = 0; start < model.joints.size(); ++start) {
    int k = static_cast<int>(start);
    while (k >= 0 && visit[at(k)] < 0) {
      visit[at(k)] = static_cast<int>(start);
      k = joint(model, k).mimic ? joint(model, k).mimic->leader : -1;
    }
    if (k < 0 || visit[at(k)] != static_cast<int>(start)) continue;
    const Joint& j = joint(model, k);
    const bool itself = j.mimic->leader == k;
    findings.error({j.mimic->location, named("joint", j.name),
                    itself ? "<mimic>: follows itself" : "<mimic>: follows itself through others",
                    "one joint of the group must move on its own"});
  }
}

}  // namespace

std::vector<int> joints_onto(const Model& model) {
  std::vector<int> joint_of(model.links.size(), -1);
  for (size_t k = model.joints.size(); k-- > 0;)
    joint_of[at(model.joints[k].child)] = static_cast<int>(k);
  return joint_of;
}

std::vector<int> outward(const Model& model, const std::vector<int>& joint_of) {
  std::vector<std::vector<int>> children(model.links.size());
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& j = model.joints[k];
    if (j.parent >= 0 && at(joint_of[at(j.child)]) == k) children[at(j.parent)].push_back(j.child);
  }
  std::vector<int> order{model.root};
  for (size_t k = 0; k < order.size(); ++k) {
    const auto& next = children[at(order[k])];
    order.insert(order.end(), next.begin(), next.end());
  }
  return order;
}

void validate(Model& model, Findings& findings) {
  const bool links_unique = names_are_unique(model.links, "link", findings);
  const bool joints_unique = names_are_unique(model.joints, "joint", findings);
  if (joints_unique) {
    check_mimic_ends(model, findings);
    check_mimic_cycles(model, findings);
  }
  if (!links_unique || !is_resolved(model) || model.links.empty()) return;
  const std::vector<int> joint_of = joints_onto(model);
  if (each_link_has_one_parent(model, joint_of, findings) &&
      is_one_tree(model, joint_of, findings) && !model.kinematic)
    check_masses(model, findings);
}

}  // namespace arboc

// split_joints(): every freedom that needs no joint of its own kind becomes a joint of one freedom.
#include <fmt/format.h>

#include <unordered_set>

#include "model/configure_steps.h"

namespace arboc {
namespace {

class Splitter {
 public:
  explicit Splitter(Model& model) : model_(model) {
    for (const Link& link : model.links) link_names_.insert(link.name);
    for (const Joint& joint : model.joints) joint_names_.insert(joint.name);
  }

  void run() {
    const size_t joints = model_.joints.size();
    for (size_t k = 0; k < joints; ++k) {
      if (model_.joints[k].type == JointType::kHelical) split_helical(k);
      if (!model_.joints[k].axes.empty()) split_axes(k);
    }
  }

 private:
  static std::string unused(std::string name, std::unordered_set<std::string>& names) {
    while (!names.insert(name).second) name += '_';
    return name;
  }

  /// Puts a massless link behind the joint; returns the joint from there to what it moved, at the
  /// end of the list.
  size_t insert_link(size_t k, int number) {
    Joint rest;
    rest.child = last_child_;
    rest.parent = static_cast<int>(model_.links.size());
    rest.location = model_.joints[k].location;
    const Link& link = model_.links[static_cast<size_t>(last_child_)];
    const std::string name = unused(fmt::format("{}.{}", link.name, number), link_names_);
    const Location location = link.location;
    model_.links.push_back({name, {}, location});
    model_.joints[k].child = rest.parent;
    if (model_.root == last_child_) model_.root = rest.parent;  // moved against the world
    model_.joints.push_back(rest);
    return model_.joints.size() - 1;
  }

  void split_axes(size_t k) {
    const Joint whole = model_.joints[k];
    last_child_ = whole.child;
    size_t at = k;
    for (size_t i = 0; i < whole.axes.size(); ++i) {
      const JointAxis& a = whole.axes[i];
      const int number = static_cast<int>(i) + 1;
      const size_t next = i + 1 < whole.axes.size() ? insert_link(at, number) : at;
      Joint& joint = model_.joints[at];
      joint.type = a.prismatic ? JointType::kPrismatic : JointType::kRevolute;
      joint.axis = a.axis;
      joint.axes.clear();
      joint.limits = a.limits;
      joint.damping = whole.damping;
      joint.friction = whole.friction;
      joint.rotor_inertia = whole.rotor_inertia;
      const std::string suffix = a.name.empty() ? std::to_string(number) : a.name;
      if (whole.axes.size() > 1) joint.name = unused(whole.name + "." + suffix, joint_names_);
      at = next;
    }
  }

  void split_helical(size_t k) {
    Joint turn = model_.joints[k];
    last_child_ = turn.child;
    const size_t behind = insert_link(k, 1);
    Joint slide;
    slide.name = unused(turn.name + ".slide", joint_names_);
    slide.type = JointType::kPrismatic;
    slide.parent = turn.parent;
    slide.child = model_.joints[k].child;
    slide.origin = turn.origin;
    slide.axis = turn.axis;
    slide.location = turn.location;
    slide.mimic = Mimic{static_cast<int>(behind), turn.pitch, 0, turn.location};
    turn.type = JointType::kRevolute;
    turn.parent = slide.child;
    turn.origin = {};
    turn.pitch = 0;
    for (Joint& joint : model_.joints)
      if (joint.mimic && joint.mimic->leader == static_cast<int>(k))
        joint.mimic->leader = static_cast<int>(behind);
    model_.joints[k] = slide;
    model_.joints[behind] = turn;
  }

  Model& model_;
  std::unordered_set<std::string> link_names_, joint_names_;
  int last_child_ = -1;
};

}  // namespace

void split_joints(Model& model) { Splitter(model).run(); }

}  // namespace arboc

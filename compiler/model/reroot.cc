// reroot(): the same body, hung from another of its links.
//
// A joint leads its child by T(q) = X E(q), the constant placement X and the motion E about its
// axes.  Seen from the child the parent stands at E(q)^-1 X^-1: the axes in reverse order and
// reversed, q as before, and behind them the inverse placement, which is a fixed joint here.
// [Astronaut] hangs the body of its ladder from the wrist that grips.
#include <fmt/format.h>

#include <algorithm>

#include "model/configure_steps.h"
#include "model/findings.h"
#include "model/names.h"
#include "model/validate.h"

namespace arboc {
namespace {

size_t at(int index) { return static_cast<size_t>(index); }

Pose inverse(const Pose& pose) {
  const Matrix3<double> back = transpose(rotation(pose));
  Pose result;
  result.turn = back;
  result.xyz = -(back * pose.xyz);
  result.rest = -(back * pose.rest);
  for (const LengthTerm& term : pose.terms)
    result.terms.push_back({term.length, -(back * term.slope)});
  return result;
}

class Rerooting {
 public:
  explicit Rerooting(Model& model) : model_(model) {}

  void run(int root) {
    joint_of_ = joints_onto(model_);
    joint_of_[at(model_.root)] = -1;
    std::vector<int> path;  // joints from the new root up to what holds the body
    int holder = -1;
    for (int k = root; joint_of_[at(k)] >= 0; k = joint(joint_of_[at(k)]).parent) {
      if (joint(joint_of_[at(k)]).free_root) {
        holder = joint_of_[at(k)];
        break;
      }
      path.push_back(joint_of_[at(k)]);
    }
    for (const int k : path) check(joint(k));
    for (const int k : path) reverse(k);
    if (holder >= 0)
      model_.joints[at(holder)].child = root;
    else
      model_.root = root;
  }

 private:
  const Joint& joint(int k) const { return model_.joints[at(k)]; }

  void check(const Joint& joint) const {
    switch (joint.type) {
      case JointType::kFloating:
      case JointType::kPlanar:
      case JointType::kSpherical:
        throw UsageError(printable(
            fmt::format("--hang-from: {} is {} and cannot be reversed (--expand makes a chain of "
                        "single axes of it)",
                        named("joint", joint.name), name(joint.type))));
      default: return;
    }
  }

  void reverse(int k) {
    const Joint forward = joint(k);
    Joint& back = model_.joints[at(k)];
    back.parent = forward.child;
    back.origin = {};
    if (forward.type == JointType::kFixed) {
      back.child = forward.parent;
      back.origin = inverse(forward.origin);
      return;
    }
    back.axis = -forward.axis;
    std::reverse(back.axes.begin(), back.axes.end());
    for (size_t i = 0; i < back.axes.size(); ++i) {
      back.axes[i].axis = -back.axes[i].axis;
      if (back.axes[i].name.empty()) back.axes[i].name = std::to_string(back.axes.size() - i);
    }
    back.child = static_cast<int>(model_.links.size());
    Joint behind;
    behind.name = unused(forward.name + ".fixed", model_.joints);
    behind.parent = back.child;
    behind.child = forward.parent;
    behind.origin = inverse(forward.origin);
    behind.location = forward.location;
    model_.links.push_back(
        {unused(forward.name + ".reversed", model_.links), std::nullopt, forward.location});
    model_.joints.push_back(behind);
  }

  template <class Item>
  static std::string unused(std::string name, const std::vector<Item>& items) {
    while (std::any_of(items.begin(), items.end(), [&](const Item& i) { return i.name == name; }))
      name += '_';
    return name;
  }

  Model& model_;
  std::vector<int> joint_of_;
};

}  // namespace

void reroot(Model& model, const std::string& link) {
  Rerooting(model).run(link_called(model, link, "--hang-from"));
}

}  // namespace arboc

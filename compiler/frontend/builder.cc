// What a <robot> and its <link>s mean, and which link and joint a name means; the parts of a
// <joint> are in builder_joint.cc.
#include "frontend/builder.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <unordered_map>

#include "base/number.h"
#include "base/words.h"

namespace arboc {
namespace {

bool has_control_character(std::string_view text) {
  for (size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 0x20 || c == 0x7F) return true;
    if (c == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0)
      return true;
  }
  return false;
}

}  // namespace

void ModelBuilder::start(const Element& element) {
  switch (element.spec->tag) {
    case Tag::kRobot: name_ = checked_name(element); break;
    case Tag::kLink:
      links_.push_back({checked_name(element), std::nullopt, element.where});
      if (links_.size() > kMaxLinks) {
        findings_.error(element.fault(element.where, "the robot has too many links",
                                      fmt::format("the limit is {}", kMaxLinks)));
        stopped_ = true;
      }
      break;
    case Tag::kJoint: start_joint(element); break;
    case Tag::kInertial:
      inertial_ = {};
      inertial_.inertial.location = element.where;
      inertial_.inertial.element = "<inertial>: ";
      break;
    case Tag::kMass:
      inertial_.has_mass = true;
      inertial_.complete &= element["value"].valid;
      inertial_.inertial.mass = element["value"].number[0];
      break;
    case Tag::kInertia: read_inertia(element); break;
    case Tag::kOrigin: read_origin(element); break;
    case Tag::kParent:
      joints_.back().has_parent = element["link"].present;
      joints_.back().parent = element["link"].text;
      break;
    case Tag::kChild:
      joints_.back().has_child = element["link"].present;
      joints_.back().child = element["link"].text;
      break;
    case Tag::kAxis: read_axis(element); break;
    case Tag::kLimit: read_limit(element); break;
    case Tag::kDynamics: read_dynamics(element); break;
    case Tag::kMimic: read_mimic(element); break;
    case Tag::kOther: break;
  }
}

void ModelBuilder::end(Tag tag, Location where) {
  if (tag == Tag::kInertial) end_inertial();
  if (tag == Tag::kJoint) end_joint();
  if (tag == Tag::kRobot && links_.empty())
    findings_.error({where, named("robot", name_), "it has no <link>"});
}

void ModelBuilder::ignore(const std::string& what) {
  constexpr size_t kMostKinds = 100;
  ++ignored_[ignored_.size() < kMostKinds || ignored_.contains(what) ? what : "of other kinds"];
}

std::string ModelBuilder::checked_name(const Element& element) {
  const AttributeValue& name = element["name"];
  if (!name.present) return "";
  if (name.text.empty()) {
    findings_.error(element.fault(name.where, "name is empty"));
  } else if (name.text.size() > kMaxNameBytes) {
    findings_.error(element.fault(name.where, fmt::format("name has {} bytes", name.text.size()),
                                  fmt::format("the limit is {}", kMaxNameBytes)));
  } else if (has_control_character(name.text)) {
    findings_.error(element.fault(name.where, "name contains a control character",
                                  "a name is one line of text"));
  } else if (name.text.find("${") != std::string_view::npos ||
             name.text.find("$(") != std::string_view::npos) {
    findings_.warning(element.fault(name.where,
                                    fmt::format("name {} is not expanded", quoted(name.text)),
                                    "run xacro on the file first"));
  }
  return std::string(name.text);
}

void ModelBuilder::read_origin(const Element& element) {
  constexpr double kLargestAngle = 1e9;  // the domain of exact_sincos
  constexpr double kTurn = 6.2832;       // as people round 2 pi
  Pose pose;
  if (element["xyz"].valid) pose.xyz = element["xyz"].vector();
  if (const AttributeValue& rpy = element["rpy"]; rpy.valid) {
    pose.rpy = rpy.vector();
    for (int i = 0; i < 3; ++i) {
      const std::string angle = shortest(pose.rpy[i]);
      if (std::fabs(pose.rpy[i]) >= kLargestAngle)
        findings_.error(element.fault(rpy.where, fmt::format("rpy: {} rad is beyond 1e9", angle)));
      else if (std::fabs(pose.rpy[i]) > kTurn)
        findings_.warning(element.fault(rpy.where,
                                        fmt::format("rpy: {} rad is more than a turn", angle),
                                        "angles are in radians"));
    }
  }
  (element.parent == Tag::kJoint ? joint().origin : inertial_.inertial.origin) = pose;
}

void ModelBuilder::read_inertia(const Element& element) {
  inertial_.has_inertia = true;
  const auto entry = [&](const char* name) {
    inertial_.complete &= element[name].valid;
    return element[name].number[0];
  };
  Symmetric3<double>& I = inertial_.inertial.inertia;
  I.xx = entry("ixx");
  I.xy = entry("ixy");
  I.xz = entry("ixz");
  I.yy = entry("iyy");
  I.yz = entry("iyz");
  I.zz = entry("izz");
}

void ModelBuilder::end_inertial() {
  Link& link = links_.back();
  const auto missing = [&](const char* what, const char* hint) {
    findings_.error({inertial_.inertial.location, named("link", link.name),
                     fmt::format("<inertial>: {} is missing", what), hint});
  };
  if (!inertial_.has_mass) missing("<mass>", "write <mass value=\"...\"/>, in kg");
  if (!inertial_.has_inertia) missing("<inertia>", "write <inertia ixx=\"...\" .../>, in kg m^2");
  if (inertial_.has_mass && inertial_.has_inertia && inertial_.complete)
    link.inertial = inertial_.inertial;
}

void ModelBuilder::resolve(Model& model) {
  constexpr int kSuggestions = 20;  // each costs a look at every name
  std::unordered_map<std::string_view, int> link_index, joint_index;
  std::vector<std::string_view> link_names, joint_names;
  for (size_t k = 0; k < model.links.size(); ++k) {
    link_index.emplace(model.links[k].name, static_cast<int>(k));
    link_names.push_back(model.links[k].name);
  }
  for (size_t k = 0; k < model.joints.size(); ++k) {
    joint_index.emplace(model.joints[k].name, static_cast<int>(k));
    joint_names.push_back(model.joints[k].name);
  }
  int unknown = 0;
  const auto look_up = [&](const auto& index, const std::string& name, const auto& names,
                           Finding finding) {
    const auto found = index.find(name);
    if (found != index.end()) return found->second;
    const std::string meant = ++unknown <= kSuggestions ? nearest(name, names) : "";
    if (!meant.empty()) finding.hint = fmt::format("did you mean {}?", quoted(meant));
    findings_.error(std::move(finding));
    return -1;
  };
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const PendingJoint& pending = joints_[k];
    Joint& j = model.joints[k];
    const auto link_called = [&](const char* part, const std::string& name) {
      return look_up(link_index, name, link_names,
                     {j.location, named("joint", j.name),
                      fmt::format("<{}>: there is no link {}", part, quoted(name))});
    };
    if (pending.has_parent && pending.has_ends) j.parent = link_called("parent", pending.parent);
    if (pending.has_child && pending.has_ends) j.child = link_called("child", pending.child);
    if (j.mimic)
      j.mimic->leader =
          look_up(joint_index, pending.leader, joint_names,
                  {j.mimic->location, named("joint", j.name),
                   fmt::format("<mimic>: there is no joint {}", quoted(pending.leader))});
  }
}

void ModelBuilder::report_ignored() {
  std::string list;
  for (const auto& [what, count] : ignored_)
    list += fmt::format("{}{} {}", list.empty() ? "" : ", ", count, what);
  if (!list.empty()) findings_.note({{}, "", "ignored: " + list});
}

Model ModelBuilder::finish(bool complete) {
  Model model;
  model.name = name_;
  model.links = std::move(links_);
  for (PendingJoint& pending : joints_) model.joints.push_back(std::move(pending.joint));
  if (complete) {
    resolve(model);
    report_ignored();
  }
  return model;
}

}  // namespace arboc

#include "frontend/builder.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_map>

#include "base/number.h"

namespace arboc {
namespace {

constexpr JointType kTypes[] = {JointType::kFixed,     JointType::kRevolute, JointType::kContinuous,
                                JointType::kPrismatic, JointType::kFloating, JointType::kPlanar};

std::optional<JointType> type_called(std::string_view word) {
  for (const JointType type : kTypes)
    if (word == name(type)) return type;
  return std::nullopt;
}

std::string type_hint(std::string_view word) {
  std::vector<std::string_view> words;
  std::string list;
  for (const JointType type : kTypes) {
    words.push_back(name(type));
    list += (list.empty() ? "" : ", ") + std::string(name(type));
  }
  const size_t begin = word.find_first_not_of(" \t\r\n");
  const size_t end = word.find_last_not_of(" \t\r\n");
  if (begin != std::string_view::npos) word = word.substr(begin, end - begin + 1);
  const std::string meant = nearest(word, words);
  return meant.empty() ? "URDF has " + list : fmt::format("did you mean {}?", quoted(meant));
}

bool has_control_character(std::string_view text) {
  for (size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 0x20 || c == 0x7F) return true;
    if (c == 0xC2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xA0)
      return true;
  }
  return false;
}

/// The unit vector along `v`, exactly `v` where that is a unit up to rounding; scaled first, so
/// that squares neither overflow nor vanish.  Nothing if v has no direction to speak of.
std::optional<Vector3<double>> direction(const Vector3<double>& v, double& length) {
  constexpr double kShortest = 1e-100;
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  const double largest = std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z)));
  length = largest;
  if (largest < kShortest) return std::nullopt;
  const Vector3<double> scaled{v.x / largest, v.y / largest, v.z / largest};
  const double scaled_length = std::sqrt(dot(scaled, scaled));
  length = largest * scaled_length;
  if (std::fabs(length - 1) <= kRounding) return v;
  return Vector3<double>{scaled.x / scaled_length, scaled.y / scaled_length,
                         scaled.z / scaled_length};
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

bool ModelBuilder::uses(Tag tag) const {
  if (joints_.empty()) return true;
  const JointType type = joints_.back().joint.type;
  const bool moves = type != JointType::kFixed;
  switch (tag) {
    case Tag::kAxis: return moves && type != JointType::kFloating;
    case Tag::kLimit: return nv(type) == 1;
    case Tag::kDynamics:
    case Tag::kMimic: return moves;
    default: return true;
  }
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
  }
  return std::string(name.text);
}

void ModelBuilder::start_joint(const Element& element) {
  joints_.emplace_back();
  joint().name = checked_name(element);
  joint().location = element.where;
  joint().type = JointType::kContinuous;  // asks for least if the type is not known
  if (joints_.size() > kMaxLinks) {
    findings_.error(element.fault(element.where, "the robot has too many joints",
                                  fmt::format("the limit is {}", kMaxLinks)));
    stopped_ = true;
  }
  const AttributeValue& type = element["type"];
  if (!type.present) return;
  if (const auto known = type_called(type.text)) {
    joint().type = *known;
  } else {
    findings_.error(element.fault(type.where, fmt::format("unknown type {}", quoted(type.text)),
                                  type_hint(type.text)));
  }
}

void ModelBuilder::read_origin(const Element& element) {
  constexpr double kLargestAngle = 1e9;  // the domain of exact_sincos
  Pose pose;
  if (element["xyz"].valid) pose.xyz = element["xyz"].vector();
  if (const AttributeValue& rpy = element["rpy"]; rpy.valid) {
    pose.rpy = rpy.vector();
    for (int i = 0; i < 3; ++i)
      if (std::fabs(pose.rpy[i]) >= kLargestAngle)
        findings_.error(element.fault(
            rpy.where, fmt::format("rpy: {} rad is beyond 1e9", shortest(pose.rpy[i]))));
  }
  (element.parent == Tag::kJoint ? joint().origin : inertial_.inertial.origin) = pose;
}

void ModelBuilder::read_axis(const Element& element) {
  joints_.back().has_axis = true;
  if (!uses(Tag::kAxis) || !element["xyz"].valid) return;
  constexpr double kRounding = 1e-6;  // of axes written with few digits
  double length = 0;
  const auto unit = direction(element["xyz"].vector(), length);
  if (!unit) {
    findings_.error(element.fault(element["xyz"].where,
                                  fmt::format("length is {}", shortest(length)),
                                  "give a direction, e.g. xyz=\"0 0 1\""));
    return;
  }
  joint().axis = *unit;
  if (std::fabs(length - 1) > kRounding)
    findings_.warning(element.fault(element["xyz"].where,
                                    fmt::format("length is {}; normalised", shortest(length)),
                                    "write a vector of length 1"));
}

void ModelBuilder::read_limit(const Element& element) {
  joints_.back().has_limit = true;
  if (!uses(Tag::kLimit)) return;
  const AttributeValue &lower = element["lower"], &upper = element["upper"];
  Limits& limits = joint().limits;
  for (const char* what : {"effort", "velocity"}) {
    const AttributeValue& value = element[what];
    if (!value.valid) continue;
    (what[0] == 'e' ? limits.effort : limits.velocity) = value.number[0];
    if (value.number[0] < 0)
      findings_.error(element.fault(
          value.where, fmt::format("{} is negative ({})", what, shortest(value.number[0])),
          "limits are magnitudes"));
  }
  if (joint().type == JointType::kContinuous) {
    if (lower.present || upper.present) ignore("lower/upper of continuous joints");
    return;
  }
  limits.lower = lower.number[0];
  limits.upper = upper.number[0];
  if (!lower.present && !upper.present) {
    findings_.warning(element.fault(element.where,
                                    "neither lower nor upper is given: both are 0, so the joint "
                                    "cannot move",
                                    "give both, or use type=\"continuous\""));
  } else if (limits.lower > limits.upper && lower.valid == lower.present &&
             upper.valid == upper.present) {
    findings_.error(
        element.fault(element.where, fmt::format("lower ({}) is greater than upper ({})",
                                                 shortest(limits.lower), shortest(limits.upper))));
  }
}

void ModelBuilder::read_dynamics(const Element& element) {
  if (!uses(Tag::kDynamics)) return;
  for (const char* what : {"damping", "friction"}) {
    const AttributeValue& value = element[what];
    if (!value.valid) continue;
    (what[0] == 'd' ? joint().damping : joint().friction) = value.number[0];
    if (value.number[0] < 0)
      findings_.warning(element.fault(
          value.where, fmt::format("{} is negative ({})", what, shortest(value.number[0])),
          "it feeds energy into the joint"));
  }
}

void ModelBuilder::read_mimic(const Element& element) {
  if (!uses(Tag::kMimic)) {
    findings_.warning(element.fault(element.where, "a fixed joint cannot follow another; ignored"));
    return;
  }
  if (!element["joint"].valid) return;
  joints_.back().leader = element["joint"].text;
  Mimic mimic;
  mimic.location = element.where;
  if (element["multiplier"].valid) mimic.multiplier = element["multiplier"].number[0];
  if (element["offset"].valid) mimic.offset = element["offset"].number[0];
  if (mimic.multiplier == 0)
    findings_.warning(
        element.fault(element["multiplier"].where, "multiplier is 0: the joint never moves"));
  joint().mimic = mimic;
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

void ModelBuilder::end_joint() {
  const PendingJoint& pending = joints_.back();
  const Joint& j = pending.joint;
  const std::string owner = named("joint", j.name);
  const auto missing = [&](const char* what, std::string hint) {
    findings_.error({j.location, owner, fmt::format("{} is missing", what), std::move(hint)});
  };
  if (!pending.has_parent) missing("<parent link=\"...\"/>", "name the link that carries it");
  if (!pending.has_child) missing("<child link=\"...\"/>", "name the link that it moves");
  if (!pending.has_limit && (j.type == JointType::kRevolute || j.type == JointType::kPrismatic))
    missing("<limit>", fmt::format("a {} joint has limits", name(j.type)));
  if (!pending.has_axis && uses(Tag::kAxis))
    findings_.warning({j.location, owner, "no <axis>: the default 1 0 0 is used",
                       "write <axis xyz=\"1 0 0\"/> if that is meant"});
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

// What a <joint> and its parts mean: which parts a joint type needs, uses and ignores.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/number.h"
#include "base/words.h"
#include "frontend/builder.h"

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
    if (what[0] == 'e') limits.effort_lower = -limits.effort;
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

}  // namespace arboc

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/number.h"
#include "model/model.h"

namespace arboc {
namespace {

std::string text(const Vector3<double>& a) {
  return fmt::format("{} {} {}", shortest(a.x), shortest(a.y), shortest(a.z));
}

bool is_identity(const Matrix3<double>& R) {
  const Matrix3<double> one = Matrix3<double>::identity();
  return std::equal(&R.m[0][0], &R.m[0][0] + 9, &one.m[0][0]);
}

std::string text(const Pose& pose) {
  std::string out = fmt::format("xyz({}) rpy({})", text(pose.xyz), text(pose.rpy));
  if (!is_identity(pose.turn))
    out += fmt::format(" turn({} {} {})", text(column(pose.turn, 0)), text(column(pose.turn, 1)),
                       text(column(pose.turn, 2)));
  for (const LengthTerm& term : pose.terms)
    out += fmt::format(" length({}: {})", term.length, text(term.slope));
  return out;
}

}  // namespace

std::string print(const Model& model) {
  std::string out =
      fmt::format("model {}: {} links, {} joints, gravity({})\n", printable(model.name),
                  model.links.size(), model.joints.size(), text(model.gravity));
  for (const NamedLength& length : model.lengths)
    out += fmt::format("length '{}': {}\n", printable(length.name), shortest(length.value));
  for (const Link& link : model.links) {
    out += fmt::format("link '{}'", printable(link.name));
    if (link.inertial) {
      const Inertial& i = *link.inertial;
      out += fmt::format(": mass({}) {} inertia(xx {} yy {} zz {} xy {} xz {} yz {})",
                         shortest(i.mass), text(i.origin), shortest(i.inertia.xx),
                         shortest(i.inertia.yy), shortest(i.inertia.zz), shortest(i.inertia.xy),
                         shortest(i.inertia.xz), shortest(i.inertia.yz));
    }
    out += '\n';
  }
  const auto link_name = [&](int k) {
    return k < 0 ? std::string("world")
                 : fmt::format("'{}'", printable(model.links[static_cast<size_t>(k)].name));
  };
  for (const Joint& joint : model.joints) {
    out += fmt::format("joint '{}': {} {} -> {} {}", printable(joint.name), name(joint.type),
                       link_name(joint.parent), link_name(joint.child), text(joint.origin));
    if (has_axis(joint.type)) out += fmt::format(" axis({})", text(joint.axis));
    if (joint.pitch != 0) out += fmt::format(" pitch({})", shortest(joint.pitch));
    for (const JointAxis& a : joint.axes)
      out += fmt::format(" {}({})", a.prismatic ? "along" : "about", text(a.axis));
    if (std::isfinite(joint.limits.lower) || std::isfinite(joint.limits.upper))
      out +=
          fmt::format(" limits({} {})", shortest(joint.limits.lower), shortest(joint.limits.upper));
    if (std::isfinite(joint.limits.velocity))
      out += fmt::format(" velocity({})", shortest(joint.limits.velocity));
    if (std::isfinite(joint.limits.effort))
      out += fmt::format(" effort({})", shortest(joint.limits.effort));
    if (joint.damping != 0) out += fmt::format(" damping({})", shortest(joint.damping));
    if (std::isfinite(joint.limits.effort_lower) &&
        joint.limits.effort_lower != -joint.limits.effort)
      out += fmt::format(" effort_lower({})", shortest(joint.limits.effort_lower));
    if (joint.friction != 0) out += fmt::format(" friction({})", shortest(joint.friction));
    if (joint.stiffness != 0)
      out += fmt::format(" stiffness({}) neutral({})", shortest(joint.stiffness),
                         shortest(joint.neutral));
    if (joint.rotor_inertia != 0) out += fmt::format(" rotor({})", shortest(joint.rotor_inertia));
    if (joint.mimic)
      out += fmt::format(" mimic('{}' * {} + {})",
                         printable(model.joints[static_cast<size_t>(joint.mimic->leader)].name),
                         shortest(joint.mimic->multiplier), shortest(joint.mimic->offset));
    out += '\n';
  }
  return out;
}

}  // namespace arboc

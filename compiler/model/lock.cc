// lock_joints(): a joint that is held at a place becomes a part of the placement of its child.
#include <fmt/format.h>

#include <cmath>

#include "base/exact_trig.h"
#include "base/number.h"
#include "model/configure_steps.h"
#include "model/findings.h"
#include "model/names.h"

namespace arboc {
namespace {

struct Displacement {
  Matrix3<double> R = Matrix3<double>::identity();
  Vector3<double> p;
};

/// 1 cos + [axis] sin + axis axis^T (1 - cos).
Matrix3<double> rotation_about(const Vector3<double>& axis, double angle) {
  const auto [s, c] = exact_sincos(angle);
  const auto& [x, y, z] = axis;
  Matrix3<double> R{{{c, -s * z, s * y}, {s * z, c, -s * x}, {-s * y, s * x, c}}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) R(i, j) += (1 - c) * axis[i] * axis[j];
    if (std::fabs(axis[i]) == 1) R(i, i) = 1;  // not 1 - eps
  }
  return R;
}

/// Of a quaternion x y z w of any length but 0.
Matrix3<double> rotation_of(const double* quaternion) {
  const double x = quaternion[0], y = quaternion[1], z = quaternion[2], w = quaternion[3];
  const double k = 2 / (x * x + y * y + z * z + w * w);
  return {{{1 - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)},
           {k * (x * y + w * z), 1 - k * (x * x + z * z), k * (y * z - w * x)},
           {k * (x * z - w * y), k * (y * z + w * x), 1 - k * (x * x + y * y)}}};
}

/// Of joints with several axes.
Displacement along(const std::vector<JointAxis>& axes, const std::vector<double>& q) {
  Displacement result;
  for (size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].prismatic)
      result.p = result.p + result.R * (q[i] * axes[i].axis);
    else
      result.R = result.R * rotation_about(axes[i].axis, q[i]);
  }
  return result;
}

/// Of the child's frame at q, in its frame at q = 0.
Displacement displacement(const Joint& joint, const std::vector<double>& q) {
  switch (joint.type) {
    case JointType::kFixed: return {};
    case JointType::kRevolute:
    case JointType::kContinuous: return {rotation_about(joint.axis, q[0]), {}};
    case JointType::kUnbounded: return {rotation_about(joint.axis, std::atan2(q[1], q[0])), {}};
    case JointType::kPrismatic: return {Matrix3<double>::identity(), q[0] * joint.axis};
    case JointType::kHelical:
      return {rotation_about(joint.axis, q[0]), (joint.pitch * q[0]) * joint.axis};
    case JointType::kPlanar: {
      const Matrix3<double> F = axis_frame(joint.axis);
      return {rotation_about(joint.axis, q[2]), q[0] * column(F, 0) + q[1] * column(F, 1)};
    }
    case JointType::kFloating: return {rotation_of(q.data() + 3), {q[0], q[1], q[2]}};
    case JointType::kSpherical: return {rotation_of(q.data()), {}};
    case JointType::kUniversal:
    case JointType::kMultiAxis: return along(joint.axes, q);
  }
  return {};
}

void check(const Joint& joint, const Lock& lock) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError(printable(fmt::format("--lock: {} {}", named("joint", joint.name), why)));
  };
  if (joint.type == JointType::kFixed) refuse("is fixed");
  const auto n = static_cast<size_t>(nq(joint));
  if (lock.q.size() != n)
    refuse(fmt::format("is {} and has {} coordinate{}, not {}", name(joint.type), n,
                       n == 1 ? "" : "s", lock.q.size()));
  if (quaternion_at(joint.type) < 0) return;
  double norm = 0;
  for (size_t i = n - 4; i < n; ++i) norm += lock.q[i] * lock.q[i];
  if (!(std::fabs(std::sqrt(norm) - 1) <= 1e-6))
    refuse(fmt::format("needs a quaternion x y z w of length 1, not {}", std::sqrt(norm)));
}

void check_limits(const Model& model, const Joint& joint, double q, Diagnostics& diagnostics) {
  if (joint.limits.lower <= q && q <= joint.limits.upper) return;
  diagnostics.report({Severity::kWarning, model.file, joint.location, named("joint", joint.name),
                      fmt::format("locked at {}, beyond its limits {} and {}", shortest(q),
                                  shortest(joint.limits.lower), shortest(joint.limits.upper)),
                      ""});
}

/// Where every joint stands, as far as the locks say; empty for the others.
std::vector<std::vector<double>> places(const Model& model, const std::vector<Lock>& locks) {
  std::vector<std::vector<double>> place(model.joints.size());
  for (const Lock& lock : locks) {
    const auto k = static_cast<size_t>(joint_called(model, lock.joint, "--lock"));
    const Joint& joint = model.joints[k];
    if (joint.mimic)
      throw UsageError(printable(fmt::format(
          "--lock: {} follows {} (lock that one, or free it by --mimic independent)",
          named("joint", joint.name),
          named("joint", model.joints[static_cast<size_t>(joint.mimic->leader)].name))));
    check(joint, lock);
    if (!place[k].empty())
      throw UsageError(printable("--lock: " + named("joint", joint.name) + " is given twice"));
    place[k] = lock.q;
  }
  const Coordinates at = coordinates(model);
  std::vector<size_t> joint_with(static_cast<size_t>(at.nq));  // by its first coordinate
  for (size_t k = 0; k < model.joints.size(); ++k)
    if (at.joint[k].q >= 0 && !model.joints[k].mimic)
      joint_with[static_cast<size_t>(at.joint[k].q)] = k;
  for (size_t k = 0; k < model.joints.size(); ++k) {
    if (!model.joints[k].mimic) continue;
    const auto& leader = place[joint_with[static_cast<size_t>(at.joint[k].q)]];
    if (!leader.empty()) place[k] = {at.joint[k].multiplier * leader[0] + at.joint[k].offset};
  }
  return place;
}

}  // namespace

void lock_joints(Model& model, const std::vector<Lock>& locks, Diagnostics& diagnostics) {
  const std::vector<std::vector<double>> place = places(model, locks);
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const std::vector<double>& q = place[k];
    if (q.empty()) continue;
    Joint& joint = model.joints[k];
    if (q.size() == 1) check_limits(model, joint, q[0], diagnostics);
    if (joint.mimic)
      diagnostics.report({Severity::kNote, model.file, joint.location, named("joint", joint.name),
                          fmt::format("follows a locked joint: locked at {}", shortest(q[0])), ""});
    const Displacement moved = displacement(joint, q);
    Joint fixed;
    fixed.name = joint.name;
    fixed.parent = joint.parent;
    fixed.child = joint.child;
    fixed.location = joint.location;
    fixed.origin = joint.origin;
    const Vector3<double> slid = rotation(joint.origin) * moved.p;
    fixed.origin.xyz = joint.origin.xyz + slid;
    fixed.origin.rest = joint.origin.rest + slid;
    fixed.origin.turn = joint.origin.turn * moved.R;
    joint = fixed;
  }
}

}  // namespace arboc

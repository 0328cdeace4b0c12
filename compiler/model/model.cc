#include "model/model.h"

#include <cmath>
#include <limits>

#include "base/exact_trig.h"

namespace arboc {
namespace {

/// Rounding, not a model change: an entry this close to 0 or +-1 is meant to be that.
double clean_unit(double x) {
  constexpr double kEps = 4 * std::numeric_limits<double>::epsilon();
  const double nearest = std::nearbyint(x);
  return std::fabs(nearest) <= 1 && std::fabs(x - nearest) <= kEps ? nearest : x;
}

}  // namespace

Matrix3<double> rotation(const Pose& pose) {
  const auto [sr, cr] = exact_sincos(pose.rpy.x);
  const auto [sp, cp] = exact_sincos(pose.rpy.y);
  const auto [sy, cy] = exact_sincos(pose.rpy.z);
  Matrix3<double> R{{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
                     {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
                     {-sp, cp * sr, cp * cr}}};
  R = R * pose.turn;
  for (auto& row : R.m)
    for (double& entry : row) entry = clean_unit(entry);
  return R;
}

const char* name(JointType type) {
  switch (type) {
    case JointType::kFixed: return "fixed";
    case JointType::kRevolute: return "revolute";
    case JointType::kContinuous: return "continuous";
    case JointType::kUnbounded: return "unbounded";
    case JointType::kPrismatic: return "prismatic";
    case JointType::kHelical: return "helical";
    case JointType::kFloating: return "floating";
    case JointType::kPlanar: return "planar";
    case JointType::kSpherical: return "spherical";
    case JointType::kUniversal: return "universal";
    case JointType::kMultiAxis: return "multi-axis";
  }
  return "fixed";
}

int nv(JointType type) {
  switch (type) {
    case JointType::kFixed:
    case JointType::kMultiAxis: return 0;
    case JointType::kUniversal: return 2;
    case JointType::kPlanar:
    case JointType::kSpherical: return 3;
    case JointType::kFloating: return 6;
    default: return 1;
  }
}

int nq(JointType type) {
  const bool redundant = type == JointType::kUnbounded || quaternion_at(type) >= 0;
  return nv(type) + (redundant ? 1 : 0);
}

int nv(const Joint& joint) {
  return joint.axes.empty() ? nv(joint.type) : static_cast<int>(joint.axes.size());
}

int nq(const Joint& joint) { return joint.axes.empty() ? nq(joint.type) : nv(joint); }

bool has_axis(JointType type) {
  switch (type) {
    case JointType::kFixed:
    case JointType::kFloating:
    case JointType::kSpherical:
    case JointType::kUniversal:
    case JointType::kMultiAxis: return false;
    default: return true;
  }
}

int quaternion_at(JointType type) {
  if (type == JointType::kFloating) return 3;
  return type == JointType::kSpherical ? 0 : -1;
}

Matrix3<double> axis_frame(const Vector3<double>& axis) {
  const auto columns = [](const Vector3<double>& x, const Vector3<double>& y,
                          const Vector3<double>& z) {
    return Matrix3<double>{{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}};
  };
  const auto unit = [](int i) {
    Vector3<double> e;
    e[i % 3] = 1;
    return e;
  };
  int smallest = 0;
  for (int i = 0; i < 3; ++i) {
    if (std::fabs(axis[i]) == 1) return columns(unit(i + 1), cross(axis, unit(i + 1)), axis);
    if (std::fabs(axis[i]) < std::fabs(axis[smallest])) smallest = i;
  }
  Vector3<double> x = unit(smallest) - axis[smallest] * axis;
  x = (1 / std::sqrt(dot(x, x))) * x;
  return columns(x, cross(axis, x), axis);
}

Coordinates coordinates(const Model& model) {
  Coordinates result;
  result.joint.resize(model.joints.size());
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    if (joint.type == JointType::kFixed || joint.mimic) continue;
    result.joint[k] = {result.nq, result.nv, 1, 0};
    result.nq += nq(joint);
    result.nv += nv(joint);
  }
  for (size_t k = 0; k < model.joints.size(); ++k) {
    if (!model.joints[k].mimic) continue;
    double multiplier = 1, offset = 0;
    size_t leader = k;
    while (const auto& mimic = model.joints[leader].mimic) {
      offset += multiplier * mimic->offset;
      multiplier *= mimic->multiplier;
      leader = static_cast<size_t>(mimic->leader);
    }
    result.joint[k] = {result.joint[leader].q, result.joint[leader].v, multiplier, offset};
  }
  return result;
}

}  // namespace arboc

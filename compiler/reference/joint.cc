#include "reference/joint.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/exact_trig.h"
#include "reference/eigen.h"

namespace arboc {
namespace {

Eigen::Quaterniond quaternion(const Eigen::VectorXd& q) { return {q[6], q[3], q[4], q[5]}; }

/// The same bits on every machine where exact_sincos reaches: results are recorded for selftests.
SinCos sincos(double x) {
  if (std::fabs(x) < 1e9) return exact_sincos(x);
  return {std::sin(x), std::cos(x)};
}

/// sin x / x.
double sinc(double x) { return std::fabs(x) < 1e-4 ? 1 - x * x / 6 : sincos(x).sin / x; }

/// (1 - cos x) / x^2, without cancellation.
double versine(double x) { return sinc(x / 2) * sinc(x / 2) / 2; }

/// (x - sin x) / x^3; the series where the difference would cancel.
double third(double x) {
  const double xx = x * x;
  if (xx < 0.01) return (1 - xx / 20 * (1 - xx / 42 * (1 - xx / 72))) / 6;
  return (x - sincos(x).sin) / (xx * x);
}

Eigen::VectorXd integrate_floating(const Eigen::VectorXd& q, const Eigen::VectorXd& dv) {
  const Eigen::Vector3d u = dv.head<3>(), w = dv.tail<3>();
  const double angle = w.norm();
  const Eigen::Matrix3d W = spatial6::skew(w);
  const Eigen::Vector3d p = u + versine(angle) * W * u + third(angle) * W * W * u;
  const Eigen::Vector3d half = sinc(angle / 2) / 2 * w;
  const Eigen::Quaterniond turn(sincos(angle / 2).cos, half.x(), half.y(), half.z());
  Eigen::VectorXd result(7);
  result.head<3>() = q.head<3>() + quaternion(q).toRotationMatrix() * p;
  result.tail<4>() = (quaternion(q) * turn).coeffs();
  return result;
}

Eigen::VectorXd integrate_planar(const Eigen::VectorXd& q, const Eigen::VectorXd& dv) {
  const double s = sinc(dv[2]), c = dv[2] * versine(dv[2]);
  const Eigen::Vector2d p(s * dv[0] - c * dv[1], c * dv[0] + s * dv[1]);
  Eigen::VectorXd result = q;
  const auto [sin, cos] = sincos(q[2]);
  result[0] += cos * p[0] - sin * p[1];
  result[1] += sin * p[0] + cos * p[1];
  result[2] += dv[2];
  return result;
}

}  // namespace

Eigen::Matrix3d rotation_about(const Eigen::Vector3d& axis, double angle) {
  const auto [s, c] = sincos(angle);
  return c * Eigen::Matrix3d::Identity() + s * spatial6::skew(axis) +
         (1 - c) * axis * axis.transpose();
}

Placement joint_placement(const Joint& joint, const Eigen::VectorXd& q) {
  const Eigen::Vector3d axis = to_eigen(joint.axis);
  switch (joint.type) {
    case JointType::kFixed: return {};
    case JointType::kRevolute:
    case JointType::kContinuous: return {rotation_about(axis, q[0]), Eigen::Vector3d::Zero()};
    case JointType::kPrismatic: return {Eigen::Matrix3d::Identity(), axis * q[0]};
    case JointType::kFloating: return {quaternion(q).toRotationMatrix(), q.head<3>()};
    case JointType::kPlanar: {
      const Eigen::Matrix3d F = to_eigen(axis_frame(joint.axis));
      return {rotation_about(axis, q[2]), F.col(0) * q[0] + F.col(1) * q[1]};
    }
  }
  return {};
}

Eigen::MatrixXd motion_subspace(const Joint& joint) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(6, nv(joint.type));
  switch (joint.type) {
    case JointType::kFixed: break;
    case JointType::kRevolute:
    case JointType::kContinuous: S.col(0).head<3>() = to_eigen(joint.axis); break;
    case JointType::kPrismatic: S.col(0).tail<3>() = to_eigen(joint.axis); break;
    case JointType::kFloating:
      S.bottomLeftCorner<3, 3>().setIdentity();
      S.topRightCorner<3, 3>().setIdentity();
      break;
    case JointType::kPlanar:
      S.bottomLeftCorner<3, 2>() = to_eigen(axis_frame(joint.axis)).leftCols<2>();
      S.col(2).head<3>() = to_eigen(joint.axis);
      break;
  }
  return S;
}

Eigen::VectorXd integrate_joint(const Joint& joint, const Eigen::VectorXd& q,
                                const Eigen::VectorXd& dv) {
  if (joint.type == JointType::kFloating) return integrate_floating(q, dv);
  if (joint.type == JointType::kPlanar) return integrate_planar(q, dv);
  return q + dv;
}

}  // namespace arboc

#include "reference/joint.h"

#include <Eigen/Geometry>

#include "reference/eigen.h"

namespace arboc {
namespace {

using spatial6::Mat3;
using spatial6::Vec3;

/// Rotation by `angle` (rad) about the unit vector `axis`.
template <class S>
Mat3<S> rotation_about(const Eigen::Vector3d& axis, const S& angle) {
  const auto [s, c] = scalar::sincos(angle);
  const Mat3<S> cross = spatial6::skew(axis).cast<S>();
  const Mat3<S> along = (axis * axis.transpose()).cast<S>();
  return c * Mat3<S>::Identity() + s * cross + (1. - c) * along;
}

/// The last four entries.
template <class S>
Eigen::Quaternion<S> quaternion(const VectorOf<S>& q) {
  const auto n = q.size();
  return {q[n - 1], q[n - 4], q[n - 3], q[n - 2]};
}

/// The quaternion of q, turned by w about the child's axes.
template <class S>
Eigen::Matrix<S, 4, 1> turned(const VectorOf<S>& q, const Vec3<S>& w) {
  const S quarter = w.cwiseProduct(w).sum() / 4.;
  const Vec3<S> half = S(scalar::sinc(quarter) / 2.) * w;
  const Eigen::Quaternion<S> turn(scalar::cosine(quarter), half.x(), half.y(), half.z());
  return (quaternion(q) * turn).coeffs();
}

/// Its inverse: the w that turns the quaternion of q0 to that of q1.
template <class S>
Vec3<S> turn_between(const VectorOf<S>& q0, const VectorOf<S>& q1) {
  const Eigen::Quaternion<S> a = quaternion(q0), b = quaternion(q1);
  const Eigen::Quaternion<S> turn = Eigen::Quaternion<S>(a.w(), -a.x(), -a.y(), -a.z()) * b;
  const double sign = scalar::real_part(turn.w()) < 0 ? -1 : 1;
  const Vec3<S> half(sign * turn.x(), sign * turn.y(), sign * turn.z());
  const S nn = half.cwiseProduct(half).sum();
  return S(2. * scalar::angle_ratio(nn, S(sign * turn.w()))) * half;
}

template <class S>
VectorOf<S> integrate_floating(const VectorOf<S>& q, const VectorOf<S>& dv) {
  const Vec3<S> u = dv.template head<3>(), w = dv.template tail<3>();
  const S xx = w.cwiseProduct(w).sum();
  const Mat3<S> W = spatial6::skew(w);
  const Vec3<S> Wu = W * u;
  const Vec3<S> p = u + scalar::versine(xx) * Wu + scalar::third(xx) * (W * Wu);
  VectorOf<S> result(7);
  result.template head<3>() = q.template head<3>() + quaternion(q).toRotationMatrix() * p;
  result.template tail<4>() = turned<S>(q, w);
  return result;
}

/// The inverse of integrate_floating: logarithm of the quaternion, then the inverse of the matrix
/// 1 + versine W + third W^2 that made p of u.
template <class S>
VectorOf<S> difference_floating(const VectorOf<S>& q0, const VectorOf<S>& q1) {
  const Vec3<S> w = turn_between(q0, q1);
  const Vec3<S> p = quaternion(q0).toRotationMatrix().transpose() *
                    (q1.template head<3>() - q0.template head<3>());
  const Mat3<S> W = spatial6::skew(w);
  const Vec3<S> Wp = W * p;
  VectorOf<S> result(6);
  result << p - Wp / 2. + scalar::cotangent_rest(S(w.cwiseProduct(w).sum())) * (W * Wp), w;
  return result;
}

/// (x, y) turned by `angle`.
template <class S>
Eigen::Matrix<S, 2, 1> turned(const S& angle, const S& x, const S& y) {
  const auto [s, c] = scalar::sincos(angle);
  return {c * x - s * y, s * x + c * y};
}

/// Moving evenly while turning by x leads along the chord: half the turn, shortened by sinc(x / 2).
template <class S>
VectorOf<S> integrate_planar(const VectorOf<S>& q, const VectorOf<S>& dv) {
  const S half = dv[2] / 2.;
  const S shorter = scalar::sinc(S(half * half));
  VectorOf<S> result = q + dv;
  result.template head<2>() =
      q.template head<2>() + shorter * turned(S(q[2] + half), S(dv[0]), S(dv[1]));
  return result;
}

template <class S>
VectorOf<S> difference_planar(const VectorOf<S>& q0, const VectorOf<S>& q1) {
  VectorOf<S> result = q1 - q0;
  const S half = result[2] / 2.;
  const S shorter = scalar::sinc(S(half * half));
  result.template head<2>() =
      (turned(S(-q0[2] - half), S(result[0]), S(result[1])) / shorter).eval();
  return result;
}

}  // namespace

template <class S>
PlacementOf<S> joint_placement(const Joint& joint, const VectorOf<S>& q) {
  const Eigen::Vector3d axis = to_eigen(joint.axis);
  const Vec3<S> zero = Vec3<S>::Zero();
  switch (joint.type) {
    case JointType::kFixed: return {};
    case JointType::kRevolute:
    case JointType::kContinuous: return {rotation_about(axis, q[0]), zero};
    case JointType::kUnbounded: {
      const Mat3<S> along = (axis * axis.transpose()).cast<S>();
      const Mat3<S> across = spatial6::skew(axis).cast<S>();
      return {q[0] * (Mat3<S>::Identity() - along) + q[1] * across + along, zero};
    }
    case JointType::kPrismatic: return {Mat3<S>::Identity(), axis.cast<S>() * q[0]};
    case JointType::kFloating: return {quaternion(q).toRotationMatrix(), q.template head<3>()};
    case JointType::kSpherical: return {quaternion(q).toRotationMatrix(), zero};
    case JointType::kPlanar: {
      const Mat3<S> F = to_eigen(axis_frame(joint.axis)).cast<S>();
      return {rotation_about(axis, q[2]), F.col(0) * q[0] + F.col(1) * q[1]};
    }
    default: break;  // not there behind configure()
  }
  return {};
}

Eigen::MatrixXd motion_subspace(const Joint& joint) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(6, nv(joint.type));
  switch (joint.type) {
    case JointType::kFixed: break;
    case JointType::kRevolute:
    case JointType::kContinuous:
    case JointType::kUnbounded: S.col(0).head<3>() = to_eigen(joint.axis); break;
    case JointType::kPrismatic: S.col(0).tail<3>() = to_eigen(joint.axis); break;
    case JointType::kSpherical: S.topRows<3>().setIdentity(); break;
    case JointType::kFloating:
      S.bottomLeftCorner<3, 3>().setIdentity();
      S.topRightCorner<3, 3>().setIdentity();
      break;
    case JointType::kPlanar:
      S.bottomLeftCorner<3, 2>() = to_eigen(axis_frame(joint.axis)).leftCols<2>();
      S.col(2).head<3>() = to_eigen(joint.axis);
      break;
    default: break;  // not there behind configure()
  }
  return S;
}

template <class S>
VectorOf<S> integrate_joint(const Joint& joint, const VectorOf<S>& q,
                            const std::type_identity_t<VectorOf<S>>& dv) {
  if (joint.type == JointType::kFloating) return integrate_floating<S>(q, dv);
  if (joint.type == JointType::kPlanar) return integrate_planar<S>(q, dv);
  if (joint.type == JointType::kSpherical) return turned<S>(q, dv);
  if (joint.type == JointType::kUnbounded) return turned(S(dv[0]), S(q[0]), S(q[1]));
  return q + dv;
}

template <class S>
VectorOf<S> joint_difference(const Joint& joint, const VectorOf<S>& q0, const VectorOf<S>& q1) {
  if (joint.type == JointType::kFloating) return difference_floating<S>(q0, q1);
  if (joint.type == JointType::kPlanar) return difference_planar<S>(q0, q1);
  if (joint.type == JointType::kSpherical) return turn_between<S>(q0, q1);
  if (joint.type == JointType::kUnbounded) {
    const S c = q0[0] * q1[0] + q0[1] * q1[1], s = q0[0] * q1[1] - q0[1] * q1[0];
    return VectorOf<S>::Constant(1, scalar::angle_of(s, c));
  }
  return q1 - q0;
}

template Placement joint_placement(const Joint&, const VectorOf<double>&);
template PlacementOf<Complex> joint_placement(const Joint&, const VectorOf<Complex>&);
template VectorOf<double> integrate_joint(const Joint&, const VectorOf<double>&,
                                          const VectorOf<double>&);
template VectorOf<Complex> integrate_joint(const Joint&, const VectorOf<Complex>&,
                                           const VectorOf<Complex>&);
template VectorOf<double> joint_difference(const Joint&, const VectorOf<double>&,
                                           const VectorOf<double>&);
template VectorOf<Complex> joint_difference(const Joint&, const VectorOf<Complex>&,
                                            const VectorOf<Complex>&);

}  // namespace arboc

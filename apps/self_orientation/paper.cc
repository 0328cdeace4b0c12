#include "paper.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <stdexcept>

namespace self_orientation {
namespace {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Matrix3 skew(const Vector3& v) {
  Matrix3 out;
  out << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return out;
}

/// Motions and forces: linear part first, moments about the origin of the reference frame.
Vector6 cross_motion(const Vector6& v, const Vector6& m) {
  Vector6 out;
  out << v.tail<3>().cross(m.head<3>()) + v.head<3>().cross(m.tail<3>()),
      v.tail<3>().cross(m.tail<3>());
  return out;
}
Vector6 cross_force(const Vector6& v, const Vector6& f) {
  Vector6 out;
  out << v.tail<3>().cross(f.head<3>()),
      v.tail<3>().cross(f.tail<3>()) + v.head<3>().cross(f.head<3>());
  return out;
}
/// A turn about an axis through a point.
Vector6 turn(const Vector3& axis, const Vector3& point) {
  Vector6 out;
  out << point.cross(axis), axis;
  return out;
}

/// Of a body whose frame stands at p with axes R.
Matrix6 spatial_inertia(const Body& b, const Matrix3& R, const Vector3& p) {
  const Vector3 c = R * b.centre;
  const Matrix3 about_centre = R * b.inertia * R.transpose() + b.mass * skew(c) * skew(c);
  const Matrix3 C = skew(p + c);
  Matrix6 I;
  I << b.mass * Matrix3::Identity(), -b.mass * C, b.mass * C, about_centre - b.mass * C * C;
  return I;
}

/// A leg in motion, as far as the torso's motion leaves it open.
struct Leg {
  std::array<Vector6, 3> S;
  Matrix6 I;
  Vector6 own_velocity;  ///< S1 q1d + S2 q2d + S3 q3d
};

Leg leg(const Body& body, const Matrix3& R, const Vector3& hip, const Vector3& q,
        const Vector3& qd) {
  const Matrix3 X = Eigen::AngleAxisd(q[0], Vector3::UnitX()).toRotationMatrix(),
                Y = Eigen::AngleAxisd(q[1], Vector3::UnitY()).toRotationMatrix(),
                Z = Eigen::AngleAxisd(q[2], Vector3::UnitZ()).toRotationMatrix();
  Leg out;
  out.S = {turn(R.col(0), hip), turn((R * X).col(1), hip), turn((R * X * Y).col(2), hip)};
  out.I = spatial_inertia(body, R * X * Y * Z, hip);
  out.own_velocity = out.S[0] * qd[0] + out.S[1] * qd[1] + out.S[2] * qd[2];
  return out;
}

/// a3 - a0: S qdd + v0 x S1 q1d + v1 x S2 q2d + v2 x S3 q3d.
Vector6 own_acceleration(const Leg& l, const Vector6& v0, const Vector3& qd, const Vector3& qdd) {
  Vector6 v = v0, a = Vector6::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vector6 s = l.S[static_cast<std::size_t>(i)];
    a += s * qdd[i] + cross_motion(v, s * qd[i]);
    v += s * qd[i];
  }
  return a;
}

Vector6 force(const Matrix6& I, const Vector6& v, const Vector6& a) {
  return I * a + cross_force(v, I * v);
}

/// Motion of a point fixed in space -> of the body's frame at p, along its axes R.
Vector6 in_body(const Vector6& m, const Matrix3& R, const Vector3& p) {
  Vector6 out;
  out << R.transpose() * (m.head<3>() + m.tail<3>().cross(p)), R.transpose() * m.tail<3>();
  return out;
}

void check(const Model& model, const ThreeBodies& body) {
  Vector bent(6);
  bent << -0.3, -1.1, 0.2, 0.4, 0.3, -0.6;
  Matrix6 I = spatial_inertia(body.bodies[0], Matrix3::Identity(), Vector3::Zero());
  for (int k = 0; k < 2; ++k)
    I += leg(body.bodies[k + 1], Matrix3::Identity(), body.hips[k], bent.segment<3>(3 * k),
             Vector3::Zero())
             .I;
  const Matrix M = model.crba(model.at_origin(bent));
  if ((M.topLeftCorner<6, 6>() - I).cwiseAbs().maxCoeff() > 1e-10 * M(0, 0))
    throw std::logic_error(model.name + " is not a torso with two legs on hips XYZ");
}

}  // namespace

ThreeBodies three_bodies(const Model& model) {
  const Vector q = model.at_origin(Vector::Zero(6));
  const Matrix M = model.crba(q);
  const std::vector<double> at = model.fk(q);
  ThreeBodies out;
  std::array<Body, 3>& b = out.bodies;
  for (int k = 0; k < 2; ++k) {
    out.hips[k] = Eigen::Map<const Vector3>(at.data() + 12 * (k + 1) + 9);
    // A turn of the leg w moves its centre by w x c: momentum m w x c in the rows of the base.
    const Matrix3 momentum = M.block<3, 3>(0, 6 + 3 * k);                 // -[m c]
    b[k + 1].centre = {momentum(1, 2), -momentum(0, 2), momentum(0, 1)};  // m c still
    b[k + 1].inertia = M.block<3, 3>(6 + 3 * k, 6 + 3 * k);
  }
  // First moments about the torso's centre, sum of m_k hip_k + (m c)_k, tell the legs' masses.
  const Vector3 moment(M(1, 5), -M(0, 5), M(0, 4));
  Eigen::Matrix2d A;
  A << out.hips[0][1], out.hips[1][1], out.hips[0][2], out.hips[1][2];
  const Vector3 rest = moment - b[1].centre - b[2].centre;
  const Eigen::Vector2d masses = A.inverse() * rest.tail<2>();
  Matrix3 torso = M.block<3, 3>(3, 3);
  for (int k = 0; k < 2; ++k) {
    Body& leg_body = b[k + 1];
    leg_body.mass = masses[k];
    leg_body.centre /= masses[k];
    const Matrix3 C = skew(leg_body.centre), D = skew(leg_body.centre + out.hips[k]);
    torso -= leg_body.inertia + leg_body.mass * (C * C - D * D);
  }
  b[0] = {M(0, 0) - masses.sum(), Vector3::Zero(), torso};
  check(model, out);
  return out;
}

PaperMotion paper_motion(const ThreeBodies& body, const Vector& q, const Vector& v,
                         const Vector& a) {
  const Matrix3 R = Eigen::Quaterniond(q[6], q[3], q[4], q[5]).toRotationMatrix();
  const Vector3 p = q.head<3>();
  const Matrix6 I0 = spatial_inertia(body.bodies[0], R, p);
  std::array<Leg, 2> legs;
  for (int k = 0; k < 2; ++k)
    legs[k] = leg(body.bodies[k + 1], R, p + R * body.hips[k], q.segment<3>(7 + 3 * k),
                  v.segment<3>(6 + 3 * k));
  const Eigen::PartialPivLU<Matrix6> all(Matrix6(I0 + legs[0].I + legs[1].I));
  const Vector6 v0 =
      -all.solve(legs[0].I * legs[0].own_velocity + legs[1].I * legs[1].own_velocity);
  std::array<Vector6, 2> velocity, acceleration;
  Vector6 bias = cross_force(v0, I0 * v0);
  for (int k = 0; k < 2; ++k) {
    velocity[k] = v0 + legs[k].own_velocity;
    acceleration[k] =
        own_acceleration(legs[k], v0, v.segment<3>(6 + 3 * k), a.segment<3>(6 + 3 * k));
    bias += force(legs[k].I, velocity[k], acceleration[k]);
  }
  const Vector6 a0 = -all.solve(bias);
  PaperMotion out;
  out.wrenches = force(I0, v0, a0);
  for (int k = 0; k < 2; ++k) {
    const Vector6 f = force(legs[k].I, velocity[k], a0 + acceleration[k]);
    out.wrenches += f;
    for (int i = 0; i < 3; ++i)
      out.torques[3 * k + i] = legs[k].S[static_cast<std::size_t>(i)].dot(f);
  }
  out.v0 = in_body(v0, R, p);
  out.a0 = in_body(a0, R, p);
  return out;
}

}  // namespace self_orientation

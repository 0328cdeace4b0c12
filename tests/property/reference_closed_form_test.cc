// The reference engine against problems whose solution is known in closed form.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "reference/reference.h"

namespace arboc::test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kRounding = 1e-13;

Link body(const std::string& name, double mass, const Vector3<double>& centre, double inertia) {
  Inertial inertial;
  inertial.mass = mass;
  inertial.origin.xyz = centre;
  inertial.inertia = {inertia, 2 * inertia, 2.5 * inertia, 0, 0, 0};
  return {name, inertial, {}};
}

Joint joint(const std::string& name, JointType type, int parent, int child,
            const Vector3<double>& axis) {
  Joint result;
  result.name = name;
  result.type = type;
  result.parent = parent;
  result.child = child;
  result.axis = axis;
  return result;
}

/// Links of length `l` in the plane x = 0 that hang down at q = 0 and turn about +x.
Model pendulum(int links, double l) {
  Model model;
  model.root = 0;
  model.links.push_back({"base", {}, {}});
  for (int k = 0; k < links; ++k) {
    const std::string number = std::to_string(k + 1);
    model.links.push_back(body("link" + number, 1.5 + k, {0, 0, -l / 2}, 0.1));
    model.joints.push_back(joint("joint" + number, JointType::kRevolute, k, k + 1, {1, 0, 0}));
    if (k > 0) model.joints.back().origin.xyz = {0, 0, -l};
  }
  return model;
}

TEST(ReferenceClosedForm, Pendulum) {
  const Reference reference(pendulum(1, 0.8));
  const double m = 1.5, c = 0.4, I = 0.1, g = 9.81, q = 0.7;
  const VectorXd one = VectorXd::Ones(1);
  const double expected = (I + m * c * c) * 3 + m * g * c * std::sin(q);
  EXPECT_NEAR(reference.rnea(q * one, 5 * one, 3 * one)[0], expected, kRounding);
  EXPECT_NEAR(reference.aba(q * one, 5 * one, expected * one)[0], 3, kRounding);
  EXPECT_NEAR(reference.fk(q * one)[1].R.col(1).z(), std::sin(q), kRounding);
}

TEST(ReferenceClosedForm, DoublePendulum) {
  const double l = 0.8, c = 0.4, I = 0.1, g = 9.81, m1 = 1.5, m2 = 2.5;
  const Reference reference(pendulum(2, l));
  const Vector2d q(0.7, -1.1), v(1.3, -0.4), a(2.1, 0.9);
  const double cos2 = std::cos(q[1]), sin2 = std::sin(q[1]), h = m2 * l * c * sin2;
  Eigen::Matrix2d M;
  M(1, 1) = I + m2 * c * c;
  M(0, 1) = M(1, 0) = M(1, 1) + m2 * l * c * cos2;
  M(0, 0) = I + m1 * c * c + m2 * l * l + M(1, 1) + 2 * m2 * l * c * cos2;
  const Vector2d coriolis(-h * (2 * v[0] * v[1] + v[1] * v[1]), h * v[0] * v[0]);
  const double g2 = m2 * c * g * std::sin(q[0] + q[1]);
  const Vector2d gravity((m1 * c + m2 * l) * g * std::sin(q[0]) + g2, g2);

  EXPECT_LE((reference.crba(q) - M).norm(), kRounding);
  EXPECT_LE((reference.gravity(q) - gravity).norm(), kRounding);
  EXPECT_LE((reference.nle(q, v) - coriolis - gravity).norm(), kRounding);
  EXPECT_LE((reference.aba(q, v, M * a + coriolis + gravity) - a).norm(), kRounding);
}

TEST(ReferenceClosedForm, FollowerMakesOnePendulumOfTwo) {
  Model model = pendulum(2, 0.8);
  model.joints[1].mimic = Mimic{0, -2, 0.3};
  const Reference reference(model), free(pendulum(2, 0.8));
  const double q = 0.7;
  const Vector2d q_full(q, -2 * q + 0.3), G(1, -2);
  const VectorXd one = VectorXd::Ones(1);
  ASSERT_EQ(reference.nv(), 1);
  EXPECT_NEAR(reference.rnea(q * one, 1.3 * one, 2.1 * one)[0],
              G.dot(free.rnea(q_full, 1.3 * G, 2.1 * G)), kRounding);
  EXPECT_NEAR(reference.crba(q * one)(0, 0), G.dot(free.crba(q_full) * G), kRounding);
}

Model single_body(JointType type, const Vector3<double>& axis) {
  Model model;
  model.root = 0;
  model.links = {{"base", {}, {}}, body("body", 2, {0.1, -0.2, 0.3}, 0.1)};
  model.joints = {joint("joint", type, 0, 1, axis)};
  return model;
}

/// Without forces the centre of mass falls and the body turns by Euler's equations.
TEST(ReferenceClosedForm, FreeBodyFallsAndPrecesses) {
  const Reference reference(single_body(JointType::kFloating, {1, 0, 0}));
  const Vector3d c(0.1, -0.2, 0.3), I(0.1, 0.2, 0.25), w(0.4, -1.2, 2.0), u(1, 2, -3);
  VectorXd q(7), v(6);
  q << 1, 2, 3, 0.5, -0.5, 0.1, 0.7;
  q.tail<4>().normalize();
  v << u, w;
  const Eigen::Matrix3d R = Eigen::Quaterniond(q[6], q[3], q[4], q[5]).toRotationMatrix();
  const VectorXd a = reference.aba(q, v, VectorXd::Zero(6));

  const Vector3d wd = a.tail<3>();
  const Vector3d euler = I.cwiseProduct(wd) + w.cross(I.cwiseProduct(w));
  EXPECT_LE(euler.norm(), kRounding);
  // a is the derivative of v's components: the acceleration of the origin is a + w x v.
  const Vector3d origin = a.head<3>() + w.cross(u);
  const Vector3d centre = origin + wd.cross(c) + w.cross(w.cross(c));
  EXPECT_LE((R * centre - Vector3d(0, 0, -9.81)).norm(), kRounding);
}

/// A planar joint moves in the plane normal to its axis, with velocities in the body's axes.
TEST(ReferenceClosedForm, PlanarJointStaysInItsPlane) {
  for (const Vector3<double>& axis :
       {Vector3<double>{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0.6, 0, 0.8}}) {
    const Model model = single_body(JointType::kPlanar, axis);
    const Reference reference(model);
    const Vector3d n(axis.x, axis.y, axis.z), q(0.3, -0.4, 1.1), v(0.7, 0.2, -0.9);
    const Placement T = reference.fk(q)[1];
    EXPECT_NEAR(T.p.dot(n), 0, kRounding);
    EXPECT_NEAR(T.p.norm(), 0.5, kRounding);
    EXPECT_LE((T.R * n - n).norm(), kRounding);
    const double speed = v.head<2>().norm();  // of the origin, whatever the heading
    const Vector3d c(0.1, -0.2, 0.3), r = T.R * (c - c.dot(n) * n);
    const Vector3d after = reference.fk(reference.integrate(q, 1e-6 * v))[1].p;
    EXPECT_NEAR((after - T.p).norm() / 1e-6, speed, 1e-6);  // first difference
    EXPECT_NEAR(reference.crba(q)(0, 0), 2, kRounding);
    EXPECT_NEAR(
        reference.crba(q)(2, 2),
        2 * r.squaredNorm() + 0.1 * n.x() * n.x() + 0.2 * n.y() * n.y() + 0.25 * n.z() * n.z(),
        kRounding);
  }
}

}  // namespace
}  // namespace arboc::test

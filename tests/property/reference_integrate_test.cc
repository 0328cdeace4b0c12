// q (+) dv on the configuration manifold: group laws, units, and agreement of the two formulas of
// the exponential where they meet.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "reference/joint.h"
#include "support/random.h"

namespace arboc::test {
namespace {

using Eigen::VectorXd;

Joint joint(JointType type) {
  Joint result;
  result.type = type;
  result.axis = {0, 0, 1};
  return result;
}

VectorXd random_pose(Random& random, JointType type) {
  VectorXd q = random.vector(nq(type), 2);
  if (quaternion_at(type) >= 0) q.tail(4) = random.direction(4);
  if (type == JointType::kUnbounded) q = random.direction(2);
  return q;
}

double distance(const Placement& A, const Placement& B) {
  return (A.R - B.R).norm() + (A.p - B.p).norm();
}

class ReferenceIntegrate : public testing::TestWithParam<JointType> {};

TEST_P(ReferenceIntegrate, StepsAlongOneDirectionAdd) {
  const Joint j = joint(GetParam());
  for (const std::uint64_t seed : seeds(50)) {
    Random random(seed);
    const VectorXd q = random_pose(random, j.type);
    const VectorXd dv = random.vector(nv(j.type), std::pow(10, random.uniform(-6, 0.5)));
    const VectorXd once = integrate_joint(j, q, dv);
    const VectorXd twice = integrate_joint(j, integrate_joint(j, q, 0.3 * dv), 0.7 * dv);
    EXPECT_LE(distance(joint_placement(j, once), joint_placement(j, twice)), 1e-14 * 20);
    const VectorXd back = integrate_joint(j, once, -dv);
    EXPECT_LE(distance(joint_placement(j, back), joint_placement(j, q)), 1e-14 * 20);
  }
}

/// Many short first-order steps come to the same place, to the order of their length.
TEST_P(ReferenceIntegrate, IsTheLimitOfSmallSteps) {
  const Joint j = joint(GetParam());
  Random random(1);
  const VectorXd dv = random.vector(nv(j.type), 1);
  const VectorXd q = random_pose(random, j.type);
  const Eigen::MatrixXd S = motion_subspace(j);
  const spatial6::Vector6<double> twist = S * dv;
  constexpr int kSteps = 10000;
  Placement T = joint_placement(j, q);
  for (int k = 0; k < kSteps; ++k) {
    T.p += T.R * twist.tail<3>() / kSteps;
    T.R = T.R * Eigen::AngleAxisd(twist.head<3>().norm() / kSteps, twist.head<3>().normalized());
  }
  EXPECT_LE(distance(T, joint_placement(j, integrate_joint(j, q, dv))), 5.0 / kSteps);
}

INSTANTIATE_TEST_SUITE_P(Types, ReferenceIntegrate,
                         testing::Values(JointType::kFloating, JointType::kPlanar,
                                         JointType::kRevolute, JointType::kUnbounded,
                                         JointType::kSpherical),
                         [](const auto& type) { return std::string(name(type.param)); });

TEST(ReferenceIntegrateQuaternion, StaysUnit) {
  const Joint j = joint(JointType::kFloating);
  Random random(1);
  VectorXd q = random_pose(random, j.type);
  for (int k = 0; k < 1000; ++k) q = integrate_joint(j, q, random.vector(6, 1));
  EXPECT_NEAR(q.tail<4>().norm(), 1, 1e-13);  // a thousand roundings
}

TEST(ReferenceIntegrateQuaternion, HalfTurnAboutX) {
  VectorXd q(7), dv(6);
  q << 0, 0, 0, 0, 0, 0, 1;
  dv << 0, 1, 0, M_PI, 0, 0;  // half a circle of diameter 2 / pi
  const VectorXd after = integrate_joint(joint(JointType::kFloating), q, dv);
  VectorXd expected(7);
  expected << 0, 0, 2 / M_PI, 1, 0, 0, 0;
  EXPECT_LE((after - expected).norm(), 1e-15);
}

TEST(ReferenceIntegrateQuaternion, SeriesMeetsClosedForm) {
  VectorXd q(7), below(6), above(6);
  q << 0, 0, 0, 0, 0, 0, 1;
  below << 1, 2, 3, 0.1 * (1 - 1e-14), 0, 0;
  above << 1, 2, 3, 0.1 * (1 + 1e-14), 0, 0;
  const Joint j = joint(JointType::kFloating);
  EXPECT_LE((integrate_joint(j, q, below) - integrate_joint(j, q, above)).norm(), 1e-14);
}

}  // namespace
}  // namespace arboc::test

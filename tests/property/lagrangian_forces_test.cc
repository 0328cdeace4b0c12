// Wrenches and springs in Lagrange's form, and what they do in the generated functions.
//
// (4.30) and (4.31) of [Thesis] with the signs of torques that actuators exert:
//   tau = D a + C v + c - sum J^T R + K (q - q_n),   of a free base 0.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "functions/trace.h"
#include "reference/lagrange.h"
#include "reference/momentum.h"
#include "support/each_model.h"
#include "support/engines.h"

namespace arboc::test {
namespace {

using Eigen::VectorXd;

std::vector<double> list(const VectorXd& x) { return {x.begin(), x.end()}; }

/// rnea of the catalogue, with wrenches along the world's axes at the links' origins.
VectorXd rnea(const Model& model, const State& s, const std::vector<std::string>& links,
              const VectorXd& wrenches) {
  FunctionOptions options;
  options.external_forces = links;
  options.axes = Axes::kAligned;
  options.joint_forces.stiffness = true;
  const Setup setup = resolve(model, options);
  const Values in = {
      {"q", list(s.q)}, {"v", list(s.v)}, {"a", list(s.a)}, {"f_ext", list(wrenches)}};
  return vector_of(evaluate_generic({"rnea"}, setup, lowerings("rnea")[0], in).at("tau"));
}

Model sprung(Model model, std::uint64_t seed) {
  Random random(seed);
  for (Joint& joint : model.joints) {
    if (joint.name.starts_with("root_joint")) continue;
    joint.stiffness = random.uniform(0, 50);
    joint.neutral = random.uniform(-1, 1);
  }
  return model;
}

/// K (q - q_n) of the joints' own coordinates, as their leaders feel it.
VectorXd springs(const Model& model, const VectorXd& q) {
  const Coordinates where = coordinates(model);
  VectorXd tau = VectorXd::Zero(where.nv);
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const auto [at_q, at_v, multiplier, offset] = where.joint[k];
    if (nv(model.joints[k].type) == 0) continue;
    const Joint& joint = model.joints[k];
    tau[at_v] += multiplier * joint.stiffness * (multiplier * q[at_q] + offset - joint.neutral);
  }
  return tau;
}

std::vector<std::string> some_links(const Model& model, Random& random) {
  std::vector<std::string> names;
  for (size_t i = 1; i < model.links.size() && names.size() < 4; ++i)
    if (random.chance(0.4)) names.push_back(model.links[i].name);
  return names;
}

int index_of(const Model& model, const std::string& link) {
  int i = 0;
  while (model.links[static_cast<size_t>(i)].name != link) ++i;
  return i;
}

Model expanded(const std::string& name) {
  ModelOptions options;
  options.base = Base::kFloating;
  options.expand = true;
  return own_model(name, options);
}

TEST(LagrangianForces, WrenchesAndSpringsAreThoseOfRnea) {
  for (const auto seed : seeds(12)) {
    SCOPED_TRACE(seed);
    const char* names[] = {"ur5", "quadruped", "humanoid", "all_joints"};
    const Model model = sprung(expanded(names[seed % 4]), seed);
    Random random(seed);
    const State s = random_state(model, random);
    const std::vector<std::string> links = some_links(model, random);
    const VectorXd R = random.vector(static_cast<int>(6 * links.size()), 100);
    const Lagrangian lagrangian(model);
    VectorXd tau = lagrangian.tau(s.q, s.v, s.a) + springs(model, s.q);
    VectorXd by_wrenches = VectorXd::Zero(tau.size());
    double power = 0;
    for (size_t m = 0; m < links.size(); ++m) {
      const int link = index_of(model, links[m]);
      const auto J = lagrangian.jacobian(s.q, link, Eigen::Vector3d::Zero());
      const VectorXd own = R.segment(static_cast<Eigen::Index>(6 * m), 6);
      by_wrenches += J.transpose() * own;
      power += own.dot(frame_velocity(Reference(model), s.q, s.v, link, Axes::kAligned));
    }
    EXPECT_LE(distance(rnea(model, s, links, R), tau - by_wrenches), 1e-10);
    EXPECT_NEAR(by_wrenches.dot(s.v), power, 1e-10 * std::max(1.0, std::fabs(power)));
  }
}

/// Columns by (4.10) are derivatives of where the point is and of how the link is turned.
TEST(LagrangianForces, JacobianIsTheDerivativeOfTheTransform) {
  for (const char* name : {"ur5", "quadruped", "all_joints"}) {
    const Model model = expanded(name);
    const Reference reference(model);
    Random random(5);
    const State s = random_state(model, random);
    for (int link = 0; link < static_cast<int>(model.links.size()); ++link) {
      const Eigen::Vector3d r = random.vector(3, 0.5);
      const auto J = Lagrangian(model).jacobian(s.q, link, r);
      const TransformsOf<double> transforms(reference, s.q, link);
      for (int k = 0; k < J.cols(); ++k) {
        const Eigen::Matrix4d dT = transforms.derivative({k});
        const Eigen::Matrix4d twist = dT * transforms.inverse();
        const Eigen::Vector3d turn(twist(2, 1), twist(0, 2), twist(1, 0));
        EXPECT_LE((J.col(k).head<3>() - Eigen::Vector3d((dT * r.homogeneous()).head<3>())).norm(),
                  1e-13);
        EXPECT_LE((J.col(k).tail<3>() - turn).norm(), 1e-13);
      }
    }
  }
}

/// Half of the weight upwards on each foot, each moved by its moment to below the centre of mass:
/// nothing is left for the base.  Downwards, as if the skeleton pushed, twice the weight would be.
void expect_feet_carry(const Model& model, const std::vector<std::string>& feet) {
  const Reference reference(model);
  Random random(1);
  State s = random_state(model, random);
  s.v.setZero();
  s.a.setZero();
  const Eigen::Vector3d g(model.gravity.x, model.gravity.y, model.gravity.z);
  const double weight = g.norm() * moving_mass(model);
  const Eigen::Vector3d half = -g * moving_mass(model) / 2, centre = com(reference, s.q);
  VectorXd R(12);
  for (int f = 0; f < 2; ++f) {
    const Eigen::Vector3d p = reference.fk(s.q)[index_of(model, feet[f])].p;
    const Eigen::Matrix3d arm = spatial6::skew(Eigen::Vector3d(centre - p));
    R.segment<3>(6 * f) = half;
    R.segment<3>(6 * f + 3) = arm * half;
  }
  EXPECT_LE(rnea(model, s, feet, R).head<6>().cwiseAbs().maxCoeff(), 1e-12 * weight);
  EXPECT_NEAR(rnea(model, s, feet, -R).head<6>().norm(),
              2 * rnea(model, s, {}, {}).head<6>().norm(), 1e-12 * weight);
}

TEST(LagrangianForces, FeetCarryTheWeight) {
  expect_feet_carry(expanded("humanoid"), {"left_foot", "right_foot"});
  expect_feet_carry(own_model("santos"), {"z44", "z52"});
}

/// Without gravity a body floats in its neutral posture.
TEST(LagrangianForces, NeutralPostureIsAnEquilibrium) {
  Model model = expanded("quadruped");
  model.gravity = {0, 0, 0};
  State s{VectorXd::Zero(coordinates(model).nq), {}, {}, {}};
  s.v = s.a = VectorXd::Zero(s.q.size());
  Random random(2);
  const Coordinates where = coordinates(model);
  for (size_t k = 0; k < model.joints.size(); ++k) {
    Joint& joint = model.joints[k];
    if (nv(joint.type) == 0) continue;
    joint.stiffness = 30;
    joint.neutral = s.q[where.joint[k].q] = random.uniform(-1, 1);
  }
  EXPECT_LE(rnea(model, s, {}, {}).norm(), 1e-13);
  s.q[where.nq - 1] += 0.1;
  EXPECT_NEAR(rnea(model, s, {}, {})[where.nv - 1], 3, 1e-12);
}

}  // namespace
}  // namespace arboc::test

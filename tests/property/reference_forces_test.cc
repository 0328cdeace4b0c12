// Wrenches on links and forces of joints in the reference engine: power, energy and inversion.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "reference/frames.h"
#include "support/each_model.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Moving = arboc::State;

constexpr int kModels = 40;
constexpr double kRounding = 1e-12;  // of sums over a tree
constexpr JointForces kAll{true, true, true, true, 0.1};

Loads random_loads(const Model& model, Random& random) {
  Loads loads;
  for (const Axes axes : {Axes::kLocal, Axes::kWorld, Axes::kAligned, Axes::kLocal})
    loads.push_back(
        {random.integer(static_cast<int>(model.links.size())), axes, random.vector(6, 10)});
  return loads;
}

TEST(ReferenceForces, LoadsActThroughTheJacobian) {
  for_each_model(kModels, [](const Model& model, const Reference& r, const Moving& s) {
    Random random(1);
    const Loads loads = random_loads(model, random);
    VectorXd expected = r.rnea(s.q, s.v, s.a);
    for (const LinkWrench& load : loads)
      expected -= frame_jacobian(r, s.q, load.link, load.axes).transpose() * load.wrench;
    EXPECT_LE(distance(r.rnea(s.q, s.v, s.a, loads), expected), kRounding);
  });
}

/// Every joint on its own, from the coordinates of the model.
TEST(ReferenceForces, JointsActByTheirOwnRates) {
  for_each_model(kModels, [](const Model& model, const Reference& r, const Moving& s) {
    VectorXd expected = r.rnea(s.q, s.v, s.a);
    const Coordinates where = coordinates(model);
    for (size_t k = 0; k < model.joints.size(); ++k) {
      const Joint& joint = model.joints[k];
      const auto [q, v, multiplier, offset] = where.joint[k];
      for (int i = 0; i < nv(joint.type); ++i) {
        const double rate = multiplier * s.v[v + i];
        double force = joint.damping * rate + joint.friction * rate / std::hypot(rate, 0.1) +
                       joint.rotor_inertia * multiplier * s.a[v + i];
        if (nq(joint.type) == 1)
          force += joint.stiffness * (multiplier * s.q[q] + offset - joint.neutral);
        expected[v + i] += multiplier * force;
      }
    }
    EXPECT_LE(distance(Reference(model, kAll).rnea(s.q, s.v, s.a), expected), kRounding);
  });
}

TEST(ReferenceForces, RotorsAreInertia) {
  for_each_model(kModels, [](const Model& model, const Reference&, const Moving& s) {
    const Reference r(model, {.rotor = true});
    const VectorXd expected = r.crba(s.q) * s.a + r.nle(s.q, s.v);
    EXPECT_LE(distance(r.rnea(s.q, s.v, s.a), expected), kRounding);
    EXPECT_NEAR(r.kinetic(s.q, s.v), s.v.dot(r.crba(s.q) * s.v) / 2,
                kRounding * std::max(1.0, r.kinetic(s.q, s.v)));
  });
}

TEST(ReferenceForces, ForwardInvertsInverse) {
  for_each_model(kModels, [](const Model& model, const Reference&, const Moving& s) {
    Random random(2);
    const Reference r(model, kAll);
    const Loads loads = random_loads(model, random);
    const MatrixXd M = r.crba(s.q);
    const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues();
    const VectorXd tau = r.rnea(s.q, s.v, s.a, loads);
    // Solving amplifies rounding by the condition.
    const double tolerance = 1e-14 * eigenvalues[M.rows() - 1] / eigenvalues[0] *
                             std::max(1.0, tau.cwiseAbs().maxCoeff());
    EXPECT_LE(distance(r.aba(s.q, s.v, tau, loads), s.a), tolerance);
    EXPECT_LE(distance(M * r.minv(s.q), MatrixXd::Identity(M.rows(), M.cols())), tolerance);
  });
}

TEST(ReferenceForces, PowerIsEnergyAndLosses) {
  for_each_model(kModels, [](const Model& model, const Reference&, const Moving& s) {
    const Reference r(model, {.stiffness = true, .rotor = true});
    const auto energy = [&](double t) {
      const Moving x = after(r, s, t);
      return MatrixXd::Constant(1, 1, r.kinetic(x.q, x.v) + r.potential(x.q));
    };
    const double power = r.rnea(s.q, s.v, s.a).dot(s.v);
    // Rounding of the energies over the step.
    EXPECT_NEAR(stencil(energy, 1e-3)(0, 0), power,
                1e-9 * std::max(1.0, std::fabs(power) + std::fabs(energy(0)(0, 0))));
    const Reference losses(model, {.damping = true, .friction = true});
    EXPECT_GT((losses.rnea(s.q, s.v, s.a) - Reference(model).rnea(s.q, s.v, s.a)).dot(s.v), 0);
  });
}

}  // namespace
}  // namespace arboc::test

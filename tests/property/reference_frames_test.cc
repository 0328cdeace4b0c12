// Frames, momentum and the regressor of the reference engine: what must hold between them.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "reference/eigen.h"
#include "reference/frames.h"
#include "reference/momentum.h"
#include "reference/regressor.h"
#include "support/each_model.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Moving = arboc::State;

constexpr int kModels = 40;
constexpr double kRounding = 1e-12;  // of sums over a tree
/// Of six points 1e-3 apart: rounding over the step; velocities differ by tens in a second.
constexpr double kDifferences = 1e-9;
constexpr double kStep = 1e-3;
constexpr Axes kAxes[] = {Axes::kLocal, Axes::kWorld, Axes::kAligned};

template <class Check>
void for_each_frame(const Check& check) {
  for_each_model(kModels, [&](const Model& model, const Reference& r, const Moving& s) {
    for (int link = 0; link < static_cast<int>(model.links.size()); ++link)
      for (const Axes axes : kAxes) {
        SCOPED_TRACE(model.links[link].name + ", axes " + std::to_string(static_cast<int>(axes)));
        check(r, s, link, axes);
      }
  });
}

TEST(ReferenceFrames, VelocityIsTheJacobianTimesTheRates) {
  for_each_frame([](const Reference& r, const Moving& s, int link, Axes axes) {
    const VectorXd Jv = frame_jacobian(r, s.q, link, axes) * s.v;
    EXPECT_LE(distance(frame_velocity(r, s.q, s.v, link, axes), Jv), kRounding);
  });
}

/// From poses alone.
TEST(ReferenceFrames, VelocityIsThatOfThePoses) {
  for_each_frame([](const Reference& r, const Moving& s, int link, Axes axes) {
    const Placement T = r.fk(s.q)[link];
    const auto pose = [&](double t) -> MatrixXd {
      const Placement at = r.fk(r.integrate(s.q, t * s.v))[link];
      return (MatrixXd(3, 4) << at.R, at.p).finished();
    };
    const MatrixXd change = stencil(pose, kStep);
    const Eigen::Matrix3d W = change.leftCols<3>() * T.R.transpose();
    Vector3d w(W(2, 1), W(0, 2), W(1, 0)), l = change.col(3);
    if (axes == Axes::kWorld) l -= w.cross(T.p);
    if (axes == Axes::kLocal) {
      w = T.R.transpose() * w;
      l = T.R.transpose() * l;
    }
    const VectorXd expected = (VectorXd(6) << l, w).finished();
    EXPECT_LE(distance(frame_velocity(r, s.q, s.v, link, axes), expected), kDifferences);
  });
}

TEST(ReferenceFrames, AccelerationIsTheRateOfTheVelocity) {
  for_each_frame([](const Reference& r, const Moving& s, int link, Axes axes) {
    const VectorXd acceleration = frame_acceleration(r, s.q, s.v, s.a, link, axes);
    const VectorXd byJacobian = frame_jacobian(r, s.q, link, axes) * s.a +
                                frame_jacobian_dot(r, s.q, s.v, link, axes) * s.v;
    EXPECT_LE(distance(byJacobian, acceleration), kRounding);
    const auto velocity = [&](double t) -> MatrixXd {
      const Moving x = after(r, s, t);
      return frame_velocity(r, x.q, x.v, link, axes);
    };
    EXPECT_LE(distance(stencil(velocity, kStep), acceleration), kDifferences);
  });
}

TEST(ReferenceFrames, JacobianDotIsTheRateOfTheJacobian) {
  for_each_frame([](const Reference& r, const Moving& s, int link, Axes axes) {
    const auto jacobian = [&](double t) -> MatrixXd {
      return frame_jacobian(r, r.integrate(s.q, t * s.v), link, axes);
    };
    const MatrixXd dot = frame_jacobian_dot(r, s.q, s.v, link, axes);
    EXPECT_LE(distance(stencil(jacobian, kStep), dot), kDifferences);
  });
}

/// A leaf feels all joints before it: those columns are its own.
TEST(ReferenceFrames, JointJacobiansAreColumnsOfFrames) {
  RandomModelOptions options;
  options.mimic = false;
  for (const std::uint64_t seed : seeds(kModels)) {
    const Model model = random_model(seed, options);
    Random random(seed);
    const VectorXd q = random_state(model, random).q;
    const Reference r(model);
    const MatrixXd all = joint_jacobians(r, q);
    for (size_t link = 0; link < model.links.size(); ++link) {
      const MatrixXd own = frame_jacobian(r, q, static_cast<int>(link), Axes::kWorld);
      for (int k = 0; k < own.cols(); ++k) {
        if (own.col(k).isZero(0)) continue;
        EXPECT_LE(distance(own.col(k), all.col(k)), kRounding);
      }
    }
  }
}

TEST(ReferenceMomentumMatrix, BelongsToTheCentreOfMass) {
  for_each_model(kModels, [](const Model& model, const Reference& r, const Moving& s) {
    const Vector3d velocity = com_velocity(r, s.q, s.v);
    EXPECT_LE(distance(com_jacobian(r, s.q) * s.v, velocity), kRounding);
    const auto centre = [&](double t) -> MatrixXd { return com(r, after(r, s, t).q); };
    EXPECT_LE(distance(stencil(centre, kStep), velocity), kDifferences);
    const auto [h, A_G, dh] = centroidal(r, s.q, s.v, s.a);
    EXPECT_LE(distance(A_G * s.v, h), kRounding);
    EXPECT_LE(distance(moving_mass(model) * velocity, h.head<3>()), kRounding);
    const auto momentum = [&](double t) -> MatrixXd {
      const Moving x = after(r, s, t);
      return centroidal(r, x.q, x.v, x.a).h;
    };
    EXPECT_LE(distance(stencil(momentum, kStep), dh), kDifferences);
  });
}

/// What holds a floating base is weight and the change of momentum.
TEST(ReferenceMomentumMatrix, ChangesByTheWrenchOfTheBase) {
  for (const std::uint64_t seed : seeds(kModels)) {
    RandomModelOptions options;
    options.base = Base::kFloating;
    const Model model = random_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed));
    Random random(seed);
    const State s = random_state(model, random);
    const Reference r(model);
    const VectorXd tau = r.rnea(s.q, s.v, s.a);
    const Placement base = r.fk(s.q)[0];
    const Vector3d force = base.R * tau.head<3>(), c = com(r, s.q);
    const Vector3d moment = base.R * tau.segment<3>(3) + (base.p - c).cross(force);
    VectorXd expected(6);
    expected << force + moving_mass(model) * to_eigen(model.gravity), moment;
    EXPECT_LE(distance(centroidal(r, s.q, s.v, s.a).dh, expected), kRounding);
  }
}

TEST(ReferenceMomentumMatrix, LeavesOutWhatStands) {
  Model model;
  model.root = 0;
  const Inertial ball{{}, 2, {1, 1, 1, 0, 0, 0}, {}};
  model.links = {{"base", ball, {}}, {"post", ball, {}}, {"arm", ball, {}}};
  Joint weld;
  weld.parent = 0, weld.child = 1, weld.name = "weld";
  weld.origin.xyz = {5, 0, 0};
  Joint hinge = weld;
  hinge.type = JointType::kRevolute, hinge.parent = 1, hinge.child = 2, hinge.name = "hinge";
  model.joints = {weld, hinge};
  EXPECT_EQ(moving_mass(model), 2);
  EXPECT_EQ(com(Reference(model), VectorXd(VectorXd::Zero(1))), Vector3d(10, 0, 0));
}

TEST(ReferenceRegressor, TimesTheParametersIsInverseDynamics) {
  for_each_model(kModels, [](const Model& model, const Reference& r, const Moving& s) {
    const VectorXd tau = regressor(r, s.q, s.v, s.a) * body_parameters(model);
    EXPECT_LE(distance(tau, r.rnea(s.q, s.v, s.a)), kRounding);
  });
}

}  // namespace
}  // namespace arboc::test

// Lagrange's form against Newton's and Euler's: equations of motion, energies, structure.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "functions/engine.h"
#include "reference/frames.h"
#include "reference/lagrange.h"
#include "support/each_model.h"
#include "support/engines.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Generic engine, whose algorithms are those that are traced.
struct Generic {
  explicit Generic(const Model& model)
      : tree(lower(model, {FrameChoice::kDenavit, true})), engine(tree, {}) {}

  VectorXd rnea(const State& s) {
    VectorXd tau = VectorXd::Zero(tree.nv);
    double* out[] = {tau.data()};
    Engine<DynamicTree, double>::Inputs in;
    in.q = s.q.data();
    in.v = s.v.data();
    in.a = s.a.data();
    engine.rnea(in, out);
    return tau;
  }

  DynamicTree tree;
  Engine<DynamicTree, double> engine;
};

Model expanded(const std::string& name, Base base) {
  ModelOptions options;
  options.base = base;
  options.expand = true;
  return own_model(name, options);
}

/// Joints that turn or slide, of a tree with limbs.
Model random_tree(std::uint64_t seed, int joints) {
  Random random(seed);
  RandomModelOptions options;
  for (int k = 0; k < joints; ++k)
    options.types.push_back(random.chance(0.85) ? JointType::kRevolute : JointType::kPrismatic);
  options.mimic = seed % 2 == 0;
  return random_model(seed, options);
}

/// Inverse dynamics by the generic engine, at random states.
void expect_inverse_dynamics(const Model& model, int states) {
  const Lagrangian lagrangian(model);
  Generic generic(model);
  Random random(7);
  for (int k = 0; k < states; ++k) {
    const State s = random_state(model, random);
    // 1e-10 of the largest force: differences of thousands of products.
    ASSERT_LE(distance(lagrangian.tau(s.q, s.v, s.a), generic.rnea(s)), 1e-10)
        << model.name << ", state " << k;
  }
}

TEST(Lagrangian, IsInverseDynamicsOfOwnModels) {
  for (const char* name : {"double_pendulum", "ur5", "arm7"})
    expect_inverse_dynamics(own_model(name), 1000);
  expect_inverse_dynamics(expanded("all_joints", Base::kFloating), 200);
  expect_inverse_dynamics(expanded("quadruped", Base::kFloating), 200);
  expect_inverse_dynamics(expanded("humanoid", Base::kFloating), 100);
}

TEST(Lagrangian, IsInverseDynamicsOfTheHuman) {
  const Model model = own_model("santos");
  ASSERT_EQ(coordinates(model).nv, 55);
  expect_inverse_dynamics(model, 1000);
}

TEST(Lagrangian, IsInverseDynamicsOfATreeOf55Joints) {
  const Model model = random_tree(1, 55);
  ASSERT_EQ(coordinates(model).nv, 55);
  expect_inverse_dynamics(model, 1000);
}

/// check(model, state) on models and trees whose joints have one coordinate each.
template <class Check>
void for_each_tree(const Check& check) {
  for (const char* name : {"ur5", "quadruped", "all_joints"}) {
    SCOPED_TRACE(name);
    const Model model = expanded(name, Base::kFloating);
    Random random(3);
    check(model, random_state(model, random));
  }
  for (const auto seed : seeds(6)) {
    SCOPED_TRACE(seed);
    const Model model = random_tree(seed, 12);
    Random random(seed);
    check(model, random_state(model, random));
  }
}

VectorOf<Complex> along(const VectorXd& x, const VectorXd& direction) {
  return x.cast<Complex>() + Complex(0, 1e-30) * direction.cast<Complex>();
}

TEST(Lagrangian, InertiaIsThatOfCompositeBodies) {
  for_each_tree([](const Model& model, const State& s) {
    const MatrixXd D = Lagrangian(model).terms(s.q, s.v).D;
    EXPECT_LE(distance(D, D.transpose()), 1e-14);
    EXPECT_LE(distance(D, Reference(model).crba(s.q)), 1e-12);
  });
}

TEST(Lagrangian, TermsAreThoseOfTheEnergies) {
  for_each_tree([](const Model& model, const State& s) {
    const Lagrangian lagrangian(model);
    const LagrangianOf<Complex> complex(model);
    const Reference reference(model);
    const auto at = lagrangian.terms(s.q, s.v);
    const double K = lagrangian.kinetic(s.q, s.v);
    EXPECT_NEAR(K, s.v.dot(at.D * s.v) / 2, 1e-12 * std::max(1.0, K));
    EXPECT_NEAR(K, reference.kinetic(s.q, s.v), 1e-12 * std::max(1.0, K));
    EXPECT_NEAR(lagrangian.potential(s.q), reference.potential(s.q),
                1e-12 * std::max(1.0, std::fabs(reference.potential(s.q))));
    // c = dP/dq, and Lagrange's own d/dt dK/dv - dK/dq = D a + C v, both by complex steps.
    const auto n = static_cast<int>(s.v.size());
    VectorXd c(n), slope(n);
    for (int i = 0; i < n; ++i) {
      const VectorOf<Complex> q = along(s.q, VectorXd::Unit(n, i));
      c[i] = complex.potential(q).imag() / 1e-30;
      slope[i] = complex.kinetic(q, s.v.cast<Complex>()).imag() / 1e-30;
    }
    EXPECT_LE(distance(at.c, c), 1e-12);
    const auto moving = complex.terms(along(s.q, s.v), along(s.v, s.a));
    const VectorXd momentum = VectorOf<Complex>(moving.D * along(s.v, s.a)).imag() / 1e-30;
    EXPECT_LE(distance(at.D * s.a + at.C * s.v, momentum - slope), 1e-11);
  });
}

TEST(Lagrangian, CoriolisTermsAreChristoffels) {
  for_each_tree([](const Model& model, const State& s) {
    const LagrangianOf<Complex> complex(model);
    const auto n = static_cast<int>(s.v.size());
    std::vector<MatrixXd> dD;  // along each coordinate
    for (int k = 0; k < n; ++k)
      dD.push_back(complex.terms(along(s.q, VectorXd::Unit(n, k)), s.v.cast<Complex>()).D.imag() /
                   1e-30);
    MatrixXd C = MatrixXd::Zero(n, n), rate = MatrixXd::Zero(n, n);
    for (int m = 0; m < n; ++m) {
      rate += dD[m] * s.v[m];
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k)
          C(i, k) += (dD[m](i, k) + dD[k](i, m) - dD[i](k, m)) / 2 * s.v[m];
    }
    const MatrixXd own = Lagrangian(model).terms(s.q, s.v).C;
    EXPECT_LE(distance(own, C), 1e-11);
    const MatrixXd skew = rate - 2 * own;
    EXPECT_LE(distance(skew, -skew.transpose()), 1e-11);
  });
}

TEST(Lagrangian, PseudoInertiaTellsWhatCanExist) {
  Inertial rod;
  rod.mass = 2;
  rod.origin.xyz = {0.3, -0.1, 0.2};
  rod.origin.rpy = {0.3, 1, -0.4};
  rod.inertia = {0.1, 0.1, 0, 0, 0, 0};  // a line along z
  const auto least = [](const Inertial& inertial) {
    const Eigen::Matrix4d J = pseudo_inertia(inertial);
    EXPECT_EQ(J, J.transpose());
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(J).eigenvalues()[0];
  };
  EXPECT_NEAR(least(rod), 0, 1e-15);
  rod.inertia.zz = 0.01;
  EXPECT_GT(least(rod), 1e-4);
  rod.inertia.zz = 0.201;  // above the sum of the others
  EXPECT_LT(least(rod), -1e-4);
  // Two points of mass: the sum of m (r, 1) (r, 1)^T.
  Inertial points;
  points.mass = 3;
  points.origin.xyz = {2, 0, 1};
  points.inertia = {0, 6, 6, 0, 0, 0};  // 1 and 2 kg at x = 4 and 1, z = 1
  Eigen::Matrix4d J = Eigen::Matrix4d::Zero();
  for (const auto& [m, x] : {std::pair{1.0, 4.0}, {2.0, 1.0}}) {
    const Eigen::Vector4d r(x, 0, 1, 1);
    J += m * r * r.transpose();
  }
  EXPECT_LE((pseudo_inertia(points) - J).norm(), 1e-14);
}

TEST(Lagrangian, WantsOneCoordinateAJoint) {
  ModelOptions options;
  options.base = Base::kFloating;
  try {
    const Lagrangian lagrangian(own_model("quadruped", options));
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(
        e.what(),
        "Lagrange's equations: joint 'root_joint' has several coordinates; expand the model");
  }
}

}  // namespace
}  // namespace arboc::test

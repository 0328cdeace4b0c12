// The reference engine against the laws of mechanics, on random models of every joint type.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "reference/eigen.h"
#include "reference/reference.h"
#include "support/random_model.h"
#include "support/random_state.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kModels = 40;

struct Kind {
  const char* name;
  Base base;
  bool exotic;
};

class ReferenceDynamics : public testing::TestWithParam<Kind> {
 protected:
  template <class Property>
  static void for_random_models(Property property) {
    for (const std::uint64_t seed : seeds(kModels)) {
      RandomModelOptions options;
      options.base = GetParam().base;
      options.exotic = GetParam().exotic;
      const Model model = random_model(seed, options);
      SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
      Random random(seed);
      property(model, Reference(model), random_state(model, random));
      if (HasFailure()) return;
    }
  }
};

double scale(const MatrixXd& x) { return x.size() ? std::max(1.0, x.cwiseAbs().maxCoeff()) : 1; }

/// Largest difference relative to the largest entry of `expected` (at least 1).
double error(const MatrixXd& actual, const MatrixXd& expected) {
  return expected.size() ? (actual - expected).cwiseAbs().maxCoeff() / scale(expected) : 0;
}

double condition(const MatrixXd& M) {
  const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues();
  return eigenvalues[eigenvalues.size() - 1] / eigenvalues[0];
}

TEST_P(ReferenceDynamics, InertiaIsSymmetricAndPositive) {
  for_random_models([](const Model&, const Reference& reference, const State& x) {
    const MatrixXd M = reference.crba(x.q);
    if (M.size() == 0) return;
    EXPECT_LE(error(M, M.transpose()), 1e-14);  // rounding of sums over the tree
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(M).eigenvalues()[0], 0);
  });
}

TEST_P(ReferenceDynamics, InertiaColumnsAreDifferencesOfRnea) {
  for_random_models([](const Model&, const Reference& reference, const State& x) {
    const MatrixXd M = reference.crba(x.q);
    const VectorXd nle = reference.nle(x.q, x.v);
    MatrixXd columns(reference.nv(), reference.nv());
    for (int j = 0; j < reference.nv(); ++j)
      columns.col(j) = reference.rnea(x.q, x.v, VectorXd::Unit(reference.nv(), j)) - nle;
    EXPECT_LE(error(columns, M), 1e-12 * scale(nle));  // cancellation of nle
  });
}

TEST_P(ReferenceDynamics, ForwardInvertsInverse) {
  for_random_models([](const Model&, const Reference& reference, const State& x) {
    if (reference.nv() == 0) return;
    const MatrixXd M = reference.crba(x.q);
    const double tolerance = 1e-14 * condition(M);  // of solving with M
    const VectorXd tau = reference.rnea(x.q, x.v, x.a);
    EXPECT_LE(error(reference.aba(x.q, x.v, tau), x.a), tolerance * scale(tau));
    const MatrixXd Minv = reference.minv(x.q);
    EXPECT_LE(error(M * Minv, MatrixXd::Identity(M.rows(), M.cols())), tolerance);
    const VectorXd solved = Minv * (x.tau - reference.nle(x.q, x.v));
    EXPECT_LE(error(reference.aba(x.q, x.v, x.tau), solved), tolerance);
  });
}

TEST_P(ReferenceDynamics, KineticEnergyIsTheFormOfTheInertia) {
  for_random_models([](const Model&, const Reference& reference, const State& x) {
    const double T = reference.kinetic(x.q, x.v);
    EXPECT_NEAR(T, x.v.dot(reference.crba(x.q) * x.v) / 2, 1e-12 * std::max(1.0, T));
  });
}

TEST_P(ReferenceDynamics, GravityIsTheSlopeOfThePotential) {
  for_random_models([](const Model&, const Reference& reference, const State& x) {
    constexpr double h = 1e-5;  // truncation h^2, rounding eps/h: both near 1e-10
    VectorXd slope(reference.nv());
    for (int j = 0; j < reference.nv(); ++j) {
      const VectorXd step = h * VectorXd::Unit(reference.nv(), j);
      slope[j] = (reference.potential(reference.integrate(x.q, step)) -
                  reference.potential(reference.integrate(x.q, -step))) /
                 (2 * h);
    }
    EXPECT_LE(error(slope, reference.gravity(x.q)), 1e-8);
  });
}

TEST_P(ReferenceDynamics, PowerIsTheChangeOfEnergy) {
  for_random_models([](const Model&, const Reference& reference, const State& x) {
    constexpr double h = 1e-5;  // as above
    const auto energy = [&](double t) {
      const VectorXd q = reference.integrate(x.q, t * x.v);
      return reference.kinetic(q, x.v + t * x.a) + reference.potential(q);
    };
    const double power = reference.rnea(x.q, x.v, x.a).dot(x.v);
    const double change = (energy(h) - energy(-h)) / (2 * h);
    EXPECT_NEAR(change, power, 1e-7 * std::max(1.0, std::fabs(power) + std::fabs(energy(0))));
  });
}

/// Koenig: from nothing but the poses' differences and the links' inertias as written.
TEST_P(ReferenceDynamics, KineticEnergyIsThatOfThePoses) {
  for_random_models([](const Model& model, const Reference& reference, const State& x) {
    constexpr double h = 1e-5;  // as above
    const auto after = reference.fk(reference.integrate(x.q, h * x.v));
    const auto before = reference.fk(reference.integrate(x.q, -h * x.v));
    const auto now = reference.fk(x.q);
    double T = 0;
    for (size_t i = 0; i < now.size(); ++i) {
      if (!model.links[i].inertial) continue;
      const Inertial& inertial = *model.links[i].inertial;
      const Eigen::Vector3d c = to_eigen(inertial.origin.xyz);
      const Eigen::Vector3d speed =
          (after[i].p + after[i].R * c - before[i].p - before[i].R * c) / (2 * h);
      const Eigen::Matrix3d W = now[i].R.transpose() * (after[i].R - before[i].R) / (2 * h);
      const Eigen::Vector3d w = to_eigen(rotation(inertial.origin)).transpose() *
                                Eigen::Vector3d(W(2, 1), W(0, 2), W(1, 0));
      T += inertial.mass * speed.squaredNorm() / 2 + w.dot(to_eigen(inertial.inertia) * w) / 2;
    }
    EXPECT_NEAR(reference.kinetic(x.q, x.v), T, 1e-7 * std::max(1.0, T));
  });
}

INSTANTIATE_TEST_SUITE_P(Bases, ReferenceDynamics,
                         testing::Values(Kind{"Fixed", Base::kFixed, false},
                                         Kind{"Floating", Base::kFloating, false},
                                         Kind{"FixedExotic", Base::kFixed, true},
                                         Kind{"FloatingExotic", Base::kFloating, true}),
                         [](const auto& kind) { return kind.param.name; });

TEST(ReferenceMomentum, ChangesOnlyByWeightWhileNothingPushesTheBase) {
  for (const std::uint64_t seed : seeds(kModels)) {
    RandomModelOptions options;
    options.base = Base::kFloating;
    const Model model = random_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed));
    const Reference reference(model);
    Random random(seed);
    State x = random_state(model, random);
    x.tau.head<6>().setZero();
    const VectorXd a = reference.aba(x.q, x.v, x.tau);

    double mass = 0;
    Eigen::Vector3d moment(0, 0, 0);  // mass times centre of mass, world axes
    const auto T = reference.fk(x.q);
    for (size_t i = 0; i < T.size(); ++i) {
      if (!model.links[i].inertial) continue;
      const Inertial& inertial = *model.links[i].inertial;
      mass += inertial.mass;
      moment += inertial.mass * (T[i].p + T[i].R * to_eigen(inertial.origin.xyz));
    }
    const Eigen::Vector3d g = to_eigen(model.gravity);
    Eigen::VectorXd weight(6);
    weight << mass * g, moment.cross(g);

    const auto momentum = [&](double t) {  // about the world's origin
      const VectorXd q = reference.integrate(x.q, t * x.v);
      const VectorXd body = (reference.crba(q) * (x.v + t * a)).head(6);
      const Placement base = reference.fk(q)[0];
      const Eigen::Vector3d linear = base.R * body.head<3>();
      Eigen::VectorXd h(6);
      h << linear, base.R * body.tail<3>() + base.p.cross(linear);
      return h;
    };
    constexpr double h = 1e-5;
    const VectorXd change = (momentum(h) - momentum(-h)) / (2 * h);
    const double size = scale(momentum(0)) * scale(a);
    EXPECT_LE((change - weight).cwiseAbs().maxCoeff(), 1e-8 * size);  // differences, as above
  }
}

TEST(ReferenceDynamicsSingular, InverseDynamicsNeedsNoMass) {
  for (const std::uint64_t seed : seeds(kModels)) {
    RandomModelOptions options;
    options.massless_leaves = true;
    const Model model = random_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed));
    const Reference reference(model);
    Random random(seed);
    const State x = random_state(model, random);
    const VectorXd expected = reference.crba(x.q) * x.a + reference.nle(x.q, x.v);
    EXPECT_LE(error(reference.rnea(x.q, x.v, x.a), expected), 1e-12);  // rounding
  }
}

}  // namespace
}  // namespace arboc::test

// Derivatives of the reference engine by complex step against differences, and second ones.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "reference/frames.h"
#include "reference/momentum.h"
#include "reference/regressor.h"
#include "support/each_model.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Moving = arboc::State;

constexpr int kModels = 12;
constexpr JointForces kAll{true, true, true, true, 0.5};

/// f by complex step against six points, for each of q, v, a and tau.
template <class F>
void expect_derivatives(const Model& model, const JointForces& forces, const Moving& s, const F& f,
                        const char* what) {
  const Reference r(model, forces);
  const ComplexReference complex(model, forces);
  const auto value = [&](const Moving& x) -> MatrixXd { return MatrixXd(f(r, x)).reshaped(); };
  for (const With with : {With::kQ, With::kV, With::kA, With::kTau}) {
    const MatrixXd exact = differentiate(complex, f, s, with);
    MatrixXd differences(exact.rows(), exact.cols());
    for (int k = 0; k < r.nv(); ++k)
      differences.col(k) = stencil(
          [&](double t) { return value(moved<double>(r, s, with, t * VectorXd::Unit(r.nv(), k))); },
          2e-3);
    // Rounding of f over the step; friction bends within its velocity, its h^6 is some 1e-9.
    const double scale = std::max(1.0, value(s).cwiseAbs().maxCoeff());
    EXPECT_LE(distance(exact, differences), 1e-9 * scale) << what << static_cast<int>(with);
  }
}

TEST(ReferenceDerivatives, OfDynamicsAreThoseByDifferences) {
  for_each_model(kModels, [](const Model& model, const Reference&, const Moving& s) {
    Random random(1);
    const int links = static_cast<int>(model.links.size());
    const Loads loads{{random.integer(links), Axes::kLocal, random.vector(6, 10)},
                      {random.integer(links), Axes::kWorld, random.vector(6, 10)},
                      {random.integer(links), Axes::kAligned, random.vector(6, 10)}};
    const auto check = [&](const auto& f, const char* what) {
      expect_derivatives(model, kAll, s, f, what);
    };
    check([&](const auto& r, const auto& x) { return r.rnea(x.q, x.v, x.a, loads); }, "rnea");
    check([&](const auto& r, const auto& x) { return r.crba(x.q); }, "crba");
    check([&](const auto& r, const auto& x) { return r.gravity(x.q); }, "gravity");
  });
}

TEST(ReferenceDerivatives, OfForwardDynamicsUndoThoseOfInverse) {
  for_each_model(kModels, [](const Model& model, const Reference&, const Moving& s) {
    const ComplexReference complex(model, kAll);
    const Reference r(model, kAll);
    Moving at = s;
    at.tau = r.rnea(s.q, s.v, s.a);
    const auto rnea = [](const auto& e, const auto& x) { return e.rnea(x.q, x.v, x.a); };
    const auto aba = [](const auto& e, const auto& x) { return e.aba(x.q, x.v, x.tau); };
    const MatrixXd M = r.crba(s.q);
    const double size = std::max(1.0, M.inverse().cwiseAbs().maxCoeff());  // solving amplifies
    for (const With with : {With::kQ, With::kV}) {
      const MatrixXd expected = -differentiate(complex, rnea, at, with);
      EXPECT_LE(distance(M * differentiate(complex, aba, at, with), expected), 1e-12 * size);
    }
    EXPECT_LE(distance(differentiate(complex, rnea, at, With::kA), M), 1e-13);
    EXPECT_LE(distance(differentiate(complex, aba, at, With::kTau), r.minv(s.q)), 1e-12 * size);
  });
}

TEST(ReferenceDerivatives, OfMotionAreThoseByDifferences) {
  for_each_model(kModels, [](const Model& model, const Reference&, const Moving& s) {
    const int link = static_cast<int>(model.links.size()) - 1;
    const auto check = [&](const auto& f, const char* what) {
      expect_derivatives(model, {}, s, f, what);
    };
    for (const Axes axes : {Axes::kLocal, Axes::kWorld, Axes::kAligned}) {
      check([&](const auto& r, const auto& x) { return frame_velocity(r, x.q, x.v, link, axes); },
            "velocity");
      check([&](const auto& r,
                const auto& x) { return frame_acceleration(r, x.q, x.v, x.a, link, axes); },
            "acceleration");
      check(
          [&](const auto& r, const auto& x) { return frame_jacobian_dot(r, x.q, x.v, link, axes); },
          "jacobian dot");
    }
    check([&](const auto& r, const auto& x) { return com_jacobian(r, x.q); }, "com jacobian");
    check([&](const auto& r, const auto& x) { return centroidal(r, x.q, x.v, x.a).A_G; }, "A_G");
    check([&](const auto& r, const auto& x) { return centroidal(r, x.q, x.v, x.a).dh; }, "dh");
    check([&](const auto& r, const auto& x) { return joint_jacobians(r, x.q); }, "joints");
    check([&](const auto& r, const auto& x) { return regressor(r, x.q, x.v, x.a); }, "regressor");
  });
}

/// d h / d q v + A_G a: the same rate along two ways.
TEST(ReferenceDerivatives, OfMomentumAlongTheMotionAreItsRate) {
  for_each_model(kModels, [](const Model& model, const Reference& r, const Moving& s) {
    const ComplexReference complex(model);
    const auto h = [](const auto& e, const auto& x) { return centroidal(e, x.q, x.v, x.a).h; };
    const auto [momentum, A_G, dh] = centroidal(r, s.q, s.v, s.a);
    const VectorXd rate = differentiate(complex, h, s, With::kQ) * s.v + A_G * s.a;
    EXPECT_LE(distance(rate, dh), 1e-12);
  });
}

TEST(ReferenceDerivatives, SecondOnesAreSymmetricInOneExponential) {
  for_each_model(4, [](const Model& model, const Reference& r, const Moving& s) {
    const ComplexReference complex(model);
    Random random(1);
    const VectorXd lambda = random.vector(r.nv(), 1), d = random.vector(r.nv(), 1);
    const auto rnea = [](const auto& e, const auto& x) { return e.rnea(x.q, x.v, x.a); };
    const MatrixXd H = hessian(complex, rnea, lambda, s, With::kQ, With::kQ);
    EXPECT_LE(distance(H, H.transpose()), 1e-10);
    // Along one direction, by differences of first derivatives.
    const auto slope = [&](double t) -> MatrixXd {
      const arboc::State x = moved<double>(r, s, With::kQ, t * d);
      const VectorXd J = derivative_along(complex, rnea, arboc::complex(x), With::kQ, d);
      return MatrixXd::Constant(1, 1, lambda.dot(J));
    };
    EXPECT_LE(distance(MatrixXd::Constant(1, 1, d.dot(H * d)), stencil(slope, 2e-3)), 1e-9);
    const MatrixXd mixed = hessian(complex, rnea, lambda, s, With::kV, With::kQ);
    const MatrixXd other = hessian(complex, rnea, lambda, s, With::kQ, With::kV);
    EXPECT_LE(distance(mixed, other.transpose()), 1e-10);
  });
}

/// Both are the same in the mean; the iterated one is bent by the bracket of its directions.
TEST(ReferenceDerivatives, IteratedOnesAreSymmetricInTheMean) {
  for_each_model(4, [](const Model& model, const Reference& r, const Moving& s) {
    const ComplexReference complex(model);
    const VectorXd lambda = VectorXd::Ones(r.nv());
    const auto rnea = [](const auto& e, const auto& x) { return e.rnea(x.q, x.v, x.a); };
    const auto H = [&](Second order) {
      return hessian(complex, rnea, lambda, s, With::kQ, With::kQ, order);
    };
    const MatrixXd iterated = H(Second::kIterated);
    EXPECT_LE(distance((iterated + iterated.transpose()) / 2, H(Second::kSymmetric)), 1e-10);
  });
}

}  // namespace
}  // namespace arboc::test

// q1 (-) q0 of the reference engine undoes q0 (+) d.
#include <gtest/gtest.h>

#include <cmath>

#include "support/each_model.h"

namespace arboc::test {
namespace {

using Eigen::VectorXd;
using Moving = arboc::State;

constexpr int kModels = 40;

TEST(ReferenceDifference, UndoesIntegration) {
  for_each_model(kModels, [](const Model& model, const Reference& r, const Moving& s) {
    Random random(1);
    for (const double size : {1e-9, 1e-4, 0.1, 1.0, 1.7}) {  // 1.7 sqrt 3 is just below pi
      const VectorXd d = random.vector(r.nv(), size);
      const VectorXd there = r.integrate(s.q, d);
      EXPECT_LE(distance(r.difference(s.q, there), d), 1e-14 * 20) << size;  // rounding of q
    }
    const VectorXd other = random_state(model, random).q;
    const VectorXd d = r.difference(s.q, other), back = r.integrate(s.q, d);
    const auto expected = r.fk(other), poses = r.fk(back);
    for (size_t i = 0; i < poses.size(); ++i) {
      EXPECT_LE(distance(poses[i].R, expected[i].R), 1e-12);  // rounding, over branches
      EXPECT_LE(distance(poses[i].p, expected[i].p), 1e-12);
    }
  });
}

TEST(ReferenceDifference, TakesTheShorterTurn) {
  Joint joint;
  joint.type = JointType::kFloating;
  VectorXd q0(7), q1(7);
  q0 << 0, 0, 0, 0, 0, 0, 1;
  q1 << 0, 0, 2, std::sin(2.), 0, 0, std::cos(2.);  // by 4 rad
  const VectorXd d = joint_difference(joint, q0, q1);
  EXPECT_NEAR(d[3], 4 - 2 * M_PI, 1e-15);
  EXPECT_LE((integrate_joint(joint, q0, d) + q1).tail<4>().norm(), 1e-15);  // the other sign
}

/// Derivatives of the difference are those of the logarithm, also where series meet closed forms.
TEST(ReferenceDifference, IsAnalytic) {
  for_each_model(kModels, [](const Model& model, const Reference& r, const Moving& s) {
    const ComplexReference complex(model);
    Random random(3);
    for (const double size : {1e-7, 0.05, 0.5}) {
      const VectorXd d = random.vector(r.nv(), size), q0 = s.q, q1 = r.integrate(s.q, d);
      const auto from = [&](const auto& reference, const auto& x) {
        return reference.difference(q0.cast<Complex>(), x.q);
      };
      const Moving there{q1, {}, {}, {}};
      const Eigen::MatrixXd J = differentiate(complex, from, there, With::kQ);
      for (int k = 0; k < r.nv(); ++k) {
        const auto f = [&](double t) -> Eigen::MatrixXd {
          return r.difference(q0, r.integrate(q1, t * VectorXd::Unit(r.nv(), k)));
        };
        EXPECT_LE(distance(J.col(k), stencil(f, 1e-2)), 1e-10) << size;  // h^6 and rounding
      }
    }
  });
}

}  // namespace
}  // namespace arboc::test

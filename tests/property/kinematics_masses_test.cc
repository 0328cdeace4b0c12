// Centre of mass, momentum, energy and regressor on random models in motion.
#include "property/kinematics_cases.h"

namespace arboc::test {
namespace {

double mass_of(const DynamicTree& tree) { return total_mass<double>(tree); }

TEST(Masses, CentreOfMassMovesAsItsVelocitySays) {
  for_each_case(15, [](const KinematicCase& c) {
    const VectorXd now = vector_of(c.other("com"));
    const VectorXd rate =
        derivative([&](double t) { return VectorXd(vector_of(c.other("com", t)).head(3)); });
    EXPECT_LT(distance(now.tail(3), rate), kDifferences);
    const MatrixXd J = matrix_of(c.other("com_jacobian"), 3, c.tree.nv);
    EXPECT_LT(distance(J * c.state.v, now.tail(3)), kRounding);
  });
}

TEST(Masses, EnergiesAreThoseOfTheReference) {
  for_each_case(25, [](const KinematicCase& c) {
    const std::vector<double> got = c.other("energy");
    const double kinetic = c.reference.kinetic(c.state.q, c.state.v);
    EXPECT_NEAR(got[0], kinetic, kRounding * (1 + kinetic));
    // The reference counts links that do not move as well: compare changes.
    const KinematicInputs<double> later = c.at(0.1);
    const double change =
        c.reference.potential(vector_of(later.q)) - c.reference.potential(c.state.q);
    EXPECT_NEAR(run_other("energy", c.tree, later)[1] - got[1], change,
                kRounding * (1 + std::fabs(got[1])));
    const Vector3<double>& g = c.tree.gravity;
    const VectorXd com = vector_of(c.other("com"));
    const double expected = -mass_of(c.tree) * (g.x * com[0] + g.y * com[1] + g.z * com[2]);
    EXPECT_NEAR(got[1], expected, kRounding * (1 + std::fabs(expected)));
  });
}

TEST(Masses, MomentumIsTheMapTimesTheRates) {
  for_each_case(25, [](const KinematicCase& c) {
    const std::vector<double> got = c.other("centroidal");
    const VectorXd h = vector_of(got).head(6);
    EXPECT_LT(distance(matrix_of(got, 6, c.tree.nv, 6) * c.state.v, h), kRounding);
    EXPECT_LT(distance(mass_of(c.tree) * vector_of(c.other("com")).tail(3), h.head(3)), kRounding);
  });
}

TEST(Masses, MomentumChangesAsItsDerivativeSays) {
  for_each_case(15, [](const KinematicCase& c) {
    const VectorXd expected =
        derivative([&](double t) { return VectorXd(vector_of(c.other("centroidal", t)).head(6)); });
    EXPECT_LT(distance(vector_of(c.other("centroidal")).tail(6), expected), kDifferences);
  });
}

/// What the reference's kinetic energy leaves after the motion of the centre of mass is that of a
/// spinning body only if it has no other: a single free body checks the angular part by itself.
TEST(Masses, FreeBodySpinsWithItsInertia) {
  const Model model = random_model(1, {0, Base::kFloating});
  const DynamicTree tree = lower(model, {FrameChoice::kAxis, false});
  const Reference reference(model);
  Random random(4);
  const State state = random_state(model, random);
  const KinematicCase c{model, reference, state, tree};
  const VectorXd h = vector_of(c.other("centroidal")).head(6),
                 vc = vector_of(c.other("com")).tail(3);
  const Eigen::Vector3d w = c.frames("frame_velocity", {0}, Axes::kAligned).tail(3);
  EXPECT_NEAR(0.5 * (h.head(3).dot(vc) + h.tail(3).dot(w)), c.other("energy")[0], 1e-12);
}

/// The parameters of a body in its link frame.
VectorXd parameters(const MassMoments& inertia, const FrameOf<double>& frame) {
  const Eigen::Matrix3d R = Eigen::Matrix3d::NullaryExpr([&](Eigen::Index i, Eigen::Index j) {
    return frame.R(static_cast<int>(i), static_cast<int>(j));
  });
  const Eigen::Vector3d p(frame.p.x, frame.p.y, frame.p.z);
  const Eigen::Vector3d h(inertia.h.x, inertia.h.y, inertia.h.z);
  const Symmetric3<double>& S = inertia.Sigma;
  Eigen::Matrix3d Sigma;
  Sigma << S.xx, S.xy, S.xz, S.xy, S.yy, S.yz, S.xz, S.yz, S.zz;
  Sigma += inertia.m * p * p.transpose() - h * p.transpose() - p * h.transpose();
  Sigma = (R.transpose() * Sigma * R).eval();
  const Eigen::Matrix3d I = Sigma.trace() * Eigen::Matrix3d::Identity() - Sigma;
  VectorXd out(10);
  out << inertia.m, R.transpose() * (h - inertia.m * p), I(0, 0), I(0, 1), I(1, 1), I(0, 2),
      I(1, 2), I(2, 2);
  return out;
}

TEST(Masses, ForcesAreLinearInTheParameters) {
  for_each_case(25, [](const KinematicCase& c) {
    const int nb = c.tree.nb();
    VectorXd pi(10 * nb);
    for (const FrameOf<double>& frame : c.tree.frame)
      if (frame.moving)
        pi.segment(10 * (frame.body - 1), 10) =
            parameters(c.tree.body[static_cast<size_t>(frame.body)].inertia, frame);
    const MatrixXd Y = matrix_of(c.other("regressor"), c.tree.nv, 10 * nb);
    EXPECT_LT(distance(Y * pi, c.reference.rnea(c.state.q, c.state.v, c.state.a)), kRounding);
  });
}

}  // namespace
}  // namespace arboc::test

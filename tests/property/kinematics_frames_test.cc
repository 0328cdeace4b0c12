// Motion and Jacobians of frames against differences of placements, and against one another.
#include <Eigen/Geometry>

#include "property/kinematics_cases.h"

namespace arboc::test {
namespace {

constexpr Axes kAllAxes[] = {Axes::kLocal, Axes::kWorld, Axes::kAligned};

Eigen::Vector3d axial(const Eigen::Matrix3d& A) {
  return Eigen::Vector3d(A(2, 1) - A(1, 2), A(0, 2) - A(2, 0), A(1, 0) - A(0, 1)) / 2;
}

/// Velocity of a link by differences of its placement.
VectorXd expected_velocity(const KinematicCase& c, size_t link, Axes axes) {
  const auto placement = [&](double t) { return c.reference.fk(vector_of(c.at(t).q))[link]; };
  const Eigen::Matrix3d R = placement(0).R;
  const Eigen::Vector3d p = placement(0).p;
  const Eigen::Matrix3d dR = derivative([&](double t) { return placement(t).R; });
  const Eigen::Vector3d dp = derivative([&](double t) { return placement(t).p; });
  const Eigen::Vector3d w = axial(dR * R.transpose());
  VectorXd velocity(6);
  if (axes == Axes::kAligned) velocity << dp, w;
  if (axes == Axes::kWorld) velocity << dp - w.cross(p), w;
  if (axes == Axes::kLocal) velocity << R.transpose() * dp, R.transpose() * w;
  return velocity;
}

TEST(Frames, VelocityIsTheRateOfThePlacement) {
  for_each_case(8, [](const KinematicCase& c) {
    for (const Axes axes : kAllAxes) {
      const VectorXd all = c.frames("frame_velocity", c.all_frames(), axes);
      for (const int f : c.all_frames()) {
        const VectorXd expected = expected_velocity(c, static_cast<size_t>(f), axes);
        EXPECT_LT(distance(all.segment(6 * f, 6), expected), kDifferences) << f;
        EXPECT_LT(distance(c.frames("frame_velocity", {f}, axes), expected), kDifferences) << f;
      }
    }
  });
}

TEST(Frames, AccelerationIsTheRateOfTheVelocity) {
  for_each_case(8, [](const KinematicCase& c) {
    for (const Axes axes : kAllAxes) {
      const VectorXd all = c.frames("frame_acceleration", c.all_frames(), axes);
      const VectorXd expected =
          derivative([&](double t) { return c.frames("frame_velocity", c.all_frames(), axes, t); });
      EXPECT_LT(distance(all, expected), kDifferences);
      for (const int f : c.all_frames())
        EXPECT_LT(distance(c.frames("frame_acceleration", {f}, axes), all.segment(6 * f, 6)),
                  kRounding);
    }
  });
}

TEST(Frames, JacobiansMapRatesToMotion) {
  for_each_case(25, [](const KinematicCase& c) {
    const auto frames = c.all_frames();
    const int rows = 6 * static_cast<int>(frames.size());
    for (const Axes axes : kAllAxes) {
      const MatrixXd J = matrix_of(list(c.frames("frame_jacobian", frames, axes)), rows, c.tree.nv);
      const MatrixXd dJ =
          matrix_of(list(c.frames("frame_jacobian_dot", frames, axes)), rows, c.tree.nv);
      EXPECT_LT(distance(J * c.state.v, c.frames("frame_velocity", frames, axes)), kRounding);
      EXPECT_LT(
          distance(J * c.state.a + dJ * c.state.v, c.frames("frame_acceleration", frames, axes)),
          kRounding);
    }
  });
}

TEST(Frames, JacobianDotIsTheRateOfTheJacobian) {
  for_each_case(8, [](const KinematicCase& c) {
    for (const Axes axes : kAllAxes) {
      const VectorXd expected =
          derivative([&](double t) { return c.frames("frame_jacobian", c.all_frames(), axes, t); });
      EXPECT_LT(distance(c.frames("frame_jacobian_dot", c.all_frames(), axes), expected),
                kDifferences);
    }
  });
}

TEST(Frames, JointJacobiansAreThoseOfTheFramesThatJointsMove) {
  for_each_case(25, [](const KinematicCase& c) {
    const MatrixXd J = matrix_of(c.other("joint_jacobians"), 6, c.tree.nv);
    MatrixXd sum = MatrixXd::Zero(6, c.tree.nv);
    for (const int f : c.all_frames()) {
      // What a link's joint adds is the difference to its parent's body.
      const FrameOf<double>& frame = c.tree.frame[static_cast<size_t>(f)];
      if (!frame.moving) continue;
      const auto of = [&](int g) {
        return matrix_of(list(c.frames("frame_jacobian", {g}, Axes::kWorld)), 6, c.tree.nv);
      };
      sum += of(f);
      const int parent = c.tree.body[static_cast<size_t>(frame.body)].parent;
      for (const int g : c.all_frames()) {
        const FrameOf<double>& other = c.tree.frame[static_cast<size_t>(g)];
        if (parent > 0 && other.moving && other.body == parent) sum -= of(g);
      }
    }
    EXPECT_LT(distance(J, sum), kRounding);
  });
}

}  // namespace
}  // namespace arboc::test

// Roots of DH models: free ones, held ones, others.
#include "property/dh_support.h"

namespace arboc::test {
namespace {

// v of a floating joint is the twist in the body's frame: the Jacobian of the moved link.
struct Native {
  MatrixXd B;  // of the whole v
  VectorXd q, v, a;
};

/// The state of the model with a quaternion for root, and how its rates follow those of six axes.
Native native_state(const Model& expanded, const VectorXd& q, const VectorXd& v,
                    const VectorXd& a) {
  const Isometry3d root = place(expanded, q, "base.link");
  Native n;
  const int nv = static_cast<int>(v.size());
  n.q = VectorXd::Zero(nv + 1);
  const Eigen::Quaterniond quaternion(root.linear());
  n.q.head<3>() = root.translation();
  n.q.segment<4>(3) = quaternion.coeffs();
  n.q.tail(nv - 6) = q.tail(nv - 6);
  // Translations along the world's axes, then turns about z, x, y: w = sum of axis * rate.
  const auto twist = [&](const VectorXd& at) {
    const Matrix3d Rz = turn(Vector3d::UnitZ(), at[3]).linear();
    const Matrix3d Rzx = Rz * turn(Vector3d::UnitX(), at[4]).linear();
    const Matrix3d R = Rzx * turn(Vector3d::UnitY(), at[5]).linear();
    MatrixXd J = MatrixXd::Zero(6, 6);
    J.topLeftCorner<3, 3>() = R.transpose();
    J.block<3, 1>(3, 3) = R.transpose() * Vector3d::UnitZ();
    J.block<3, 1>(3, 4) = R.transpose() * (Rz * Vector3d::UnitX());
    J.block<3, 1>(3, 5) = R.transpose() * (Rzx * Vector3d::UnitY());
    return J;
  };
  n.B = MatrixXd::Identity(nv, nv);
  n.B.topLeftCorner<6, 6>() = twist(q);
  const double h = 1e-3;  // a stencil of six points: h^6 v^7, and rounding over h
  const auto odd = [&](int k) -> MatrixXd { return twist(q + k * h * v) - twist(q - k * h * v); };
  const MatrixXd dB = (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h);
  n.v = n.B * v;
  n.a = n.B * a;
  n.a.head<6>() += dB * v.head<6>();
  return n;
}

// A free root of six axes with dummy links between is the native joint of six freedoms.
TEST(Expanded, RootEqualsTheNativeOne) {
  const Model expanded = santos(), native = santos(with_base(Base::kFloating));
  ASSERT_EQ(coordinates(native).nq, 56);
  Random random(1);
  const Reference e(expanded), r(native);
  for (int k = 0; k < 5; ++k) {
    const VectorXd q = random_vector(55, random), v = random_vector(55, random),
                   a = random_vector(55, random);
    const Native n = native_state(expanded, q, v, a);
    for (const char* link : {"r_hand", "l_ball", "head"})
      EXPECT_LT(apart(place(expanded, q, link), place(native, n.q, link)), 1e-14);
    const MatrixXd M = n.B.transpose() * r.crba(n.q) * n.B;
    EXPECT_LT((e.crba(q) - M).cwiseAbs().maxCoeff(), 1e-12 * M.cwiseAbs().maxCoeff());
    const VectorXd tau = n.B.transpose() * r.rnea(n.q, n.v, n.a);
    EXPECT_LT((e.rnea(q, v, a) - tau).cwiseAbs().maxCoeff(), 1e-12 * tau.cwiseAbs().maxCoeff());
  }
}

// `--base fixed` holds the body where all six coordinates are 0.
TEST(Expanded, RootCanBeHeld) {
  const Model held = santos(with_base(Base::kFixed)), free = santos();
  ASSERT_EQ(coordinates(held).nv, 49);
  Random random(1);
  VectorXd q = VectorXd::Zero(55);
  q.tail(49) = random_vector(49, random);
  EXPECT_LT(apart(place(held, q.tail(49), "r_hand"), place(free, q, "r_hand")), 1e-15);
}

/// Joint-space inertia of the joints while the momentum of a floating body is 0.
MatrixXd locked_out(const MatrixXd& M) {
  const auto n = M.rows() - 6;
  return M.bottomRightCorner(n, n) -
         M.bottomLeftCorner(n, 6) * M.topLeftCorner(6, 6).ldlt().solve(M.topRightCorner(6, n));
}

/// The body hung from `root`, against the same body as its file has it; both float.
void expect_rerooted(const std::string& path, const std::string& root,
                     const std::vector<std::string>& links) {
  SCOPED_TRACE(path + " from " + root);
  Diagnostics diagnostics;
  const Model read = read_model(path, diagnostics);
  const Model hips = configured(read, with_base(Base::kFloating));
  const Model hand = configured(read, with_base(Base::kFloating, root));
  const int nv = coordinates(hips).nv, n = nv - 6;
  ASSERT_EQ(coordinates(hand).nv, nv);
  Random random(1);
  VectorXd q = random_vector(nv + 1, random), p = VectorXd::Zero(nv + 1);
  q.segment<4>(3).normalize();
  p[6] = 1;
  MatrixXd order = MatrixXd::Zero(n, n);  // rates of the joints here = order * those there
  for (const Joint& joint : hips.joints) {
    if (joint.type != JointType::kRevolute) continue;
    const int from = q_of(hips, joint.name), to = q_of(hand, joint.name);
    p[to] = q[from];
    order(from - 7, to - 7) = 1;
  }
  const Isometry3d shift = place(hips, q, root) * place(hand, p, root).inverse();
  p.head<3>() = shift.translation();
  p.segment<4>(3) = Eigen::Quaterniond(shift.linear()).coeffs();
  for (const std::string& link : links)
    EXPECT_LT(apart(place(hips, q, link), place(hand, p, link)), 1e-13) << link;
  const Reference h(hips), w(hand);
  EXPECT_NEAR(h.potential(q), w.potential(p), 1e-10);
  // What the joints feel while the momentum is 0 does not depend on the root; composed inertias of
  // 55 joints round to some 1e-13.
  const MatrixXd A = order.transpose() * locked_out(h.crba(q)) * order, B = locked_out(w.crba(p));
  EXPECT_LT((A - B).cwiseAbs().maxCoeff(), 1e-11 * A.cwiseAbs().maxCoeff());
  // The same motion has the same energy: the twists of both roots are those of their frames.
  VectorXd v = random_vector(nv, random), u(nv);
  u.tail(n) = order.transpose() * v.tail(n);
  const double t = 1e-4;
  const auto moved = [&](double s) { return place(hips, h.integrate(q, s * v), root); };
  const auto rate = [&](const auto& f) {
    return ((45 * (f(t) - f(-t)) - 9 * (f(2 * t) - f(-2 * t)) + (f(3 * t) - f(-3 * t))) / (60 * t))
        .eval();
  };
  const Eigen::Matrix4d dT = rate([&](double s) { return Eigen::Matrix4d(moved(s).matrix()); });
  const Eigen::Matrix4d twist = moved(0).inverse().matrix() * dT;
  u.head<3>() = twist.topRightCorner<3, 1>();
  u.segment<3>(3) = Vector3d(twist(2, 1), twist(0, 2), twist(1, 0));
  EXPECT_NEAR(h.kinetic(q, v), w.kinetic(p, u), 1e-8 * h.kinetic(q, v));  // differences of 1e-4
}

// Hung from a hand instead of the hips, from the left hand instead of the right: every link keeps
// its place to the others, and what does not depend on the root is the same.
TEST(Rerooting, KeepsPlacesInertiaAndEnergy) {
  for (const char* root : {"r_hand", "z29", "l_ball"})
    expect_rerooted(kSantos, root, {"z0", "z21", "z31", "z37", "z45", "z53", "base"});
  expect_rerooted(ARBOC_SOURCE_DIR "/models/astronaut_ladder/astronaut_ladder.dh.toml", "l_grip",
                  {"bar", "r_forearm", "torso", "l_grip", "feet", "thighs"});
}

TEST(Rerooting, ThereAndBackIsWhereItBegan) {
  const Model hips = santos();
  const ModelOptions there = with_base(Base::kFile, "r_hand");
  Diagnostics diagnostics;
  const Model back = configured(configured(read_model(kSantos, diagnostics), there),
                                with_base(Base::kFile, "base.link"));
  Random random(1);
  const VectorXd q = random_vector(55, random);
  VectorXd p(55);
  for (const Joint& joint : hips.joints)
    if (nv(joint) > 0) p[q_of(back, joint.name)] = q[q_of(hips, joint.name)];
  EXPECT_LT(apart(place(hips, q, "l_ball"), place(back, p, "l_ball")), 1e-13);
}

}  // namespace
}  // namespace arboc::test

// Joints of several freedoms against what they are made of: the same places, and forces and
// inertias that the map of rates carries over, in the reference and in the generic engine.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "algorithms/difference.h"
#include "algorithms/integrate.h"
#include "algorithms/rnea_derivatives.h"
#include "reference/differentiate.h"
#include "reference/reference.h"
#include "support/dual.h"
#include "support/random_model.h"
#include "support/random_state.h"
#include "tree/lower.h"

namespace arboc::test {
namespace {

using arboc::sincos;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kModels = 40;
constexpr double kTolerance = 1e-12;  // rounding

/// v of the native joint from q and v of its axes: planar, spherical (about z, y, x), floating.
template <class T>
std::vector<T> native_rates(JointType type, const T* q, const T* v) {
  if (type == JointType::kPlanar) {
    T s, c;
    sincos(q[2], s, c);
    return {c * v[0] + s * v[1], c * v[1] - s * v[0], v[2]};
  }
  const bool floating = type == JointType::kFloating;
  const T* angle = floating ? q + 3 : q;
  const T* rate = floating ? v + 3 : v;
  PlanarRotation<T> z, y, x;
  sincos(angle[0], z.s, z.c);
  sincos(angle[1], y.s, y.c);
  sincos(angle[2], x.s, x.c);
  const auto back = [&](const Vector3<T>& a) {  // Rx^T Ry^T a
    return rotate_back_x(x, Vector3<T>{y.c * a.x - y.s * a.z, a.y, y.s * a.x + y.c * a.z});
  };
  const T o(0);
  const Vector3<T> w = back({o, o, rate[0]}) + rotate_back_x(x, Vector3<T>{o, rate[1], o});
  std::vector<T> result;
  if (floating) {
    const Vector3<T> l = back(rotate_back_z(z, Vector3<T>{v[0], v[1], v[2]}));
    result = {l.x, l.y, l.z};
  }
  result.insert(result.end(), {w.x + rate[2], w.y, w.z});
  return result;
}

/// Of the native model, from those of the expanded one.
VectorXd native_q(const Joint& joint, const VectorXd& q) {
  if (quaternion_at(joint.type) < 0) return q;
  const Eigen::Vector3d angle = q.tail<3>();
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(angle[0], Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(angle[1], Eigen::Vector3d::UnitY()) *
                                  Eigen::AngleAxisd(angle[2], Eigen::Vector3d::UnitX());
  VectorXd result(nq(joint));
  result.head(q.size() - 3) = q.head(q.size() - 3);
  result.tail<4>() = turn.coeffs();
  return result;
}

/// q of the native model, G with v = G v_expanded, and G' v_expanded.
struct RateMap {
  VectorXd q;
  MatrixXd G;
  VectorXd drift;
};

/// The order of coordinates is the same in both.
RateMap rate_map(const Model& native, const State& x) {
  const Coordinates to = coordinates(native);
  int first = 0;  // coordinate of the expanded model
  RateMap map{VectorXd(to.nq), MatrixXd::Identity(to.nv, to.nv), VectorXd::Zero(to.nv)};
  for (size_t k = 0; k < native.joints.size(); ++k) {
    const Joint& joint = native.joints[k];
    if (nv(joint) == 0 || joint.mimic) continue;
    const int n = nv(joint), at = to.joint[k].v;
    const bool expands = n == 3 || n == 6;
    const VectorXd q = x.q.segment(first, expands ? n : nq(joint));
    const VectorXd v = x.v.segment(at, n);
    first += static_cast<int>(q.size());
    map.q.segment(to.joint[k].q, nq(joint)) = native_q(joint, q);
    if (!expands) continue;
    std::vector<Dual> moving, constant;
    for (int i = 0; i < n; ++i) {
      const VectorXd unit = VectorXd::Unit(n, i);
      const auto column = native_rates<double>(joint.type, q.data(), unit.data());
      for (int j = 0; j < n; ++j) map.G(at + j, at + i) = column[static_cast<size_t>(j)];
      moving.push_back(Dual(q[i]));
      moving.back().d = v[i];
      constant.push_back(Dual(v[i]));
    }
    const auto drift = native_rates<Dual>(joint.type, moving.data(), constant.data());
    for (int j = 0; j < n; ++j) map.drift[at + j] = drift[static_cast<size_t>(j)].d;
  }
  return map;
}

double error(const MatrixXd& actual, const MatrixXd& expected) {
  if (expected.size() == 0) return 0;
  return (actual - expected).cwiseAbs().maxCoeff() / std::max(1.0, expected.cwiseAbs().maxCoeff());
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// rnea and crba of both engines.
struct Dynamics {
  VectorXd tau[2];
  MatrixXd M[2];
};

Dynamics dynamics(const Model& model, const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  const Reference reference(model);
  Dynamics result;
  result.tau[0] = reference.rnea(q, v, a);
  result.M[0] = reference.crba(q);
  const DynamicTree tree = lower(model, {FrameChoice::kDenavit, true});
  RneaWorkspace<double> rnea_work(tree);
  result.tau[1].resize(tree.nv);
  rnea(tree, rnea_work, q.data(), v.data(), a.data(), result.tau[1].data());
  CrbaWorkspace<double> crba_work(tree);
  RowMajor M = RowMajor::Zero(tree.nv, tree.nv);
  crba(tree, crba_work, q.data(), UpperTriangle<double>{M.data(), tree.nv});
  result.M[1] = M.selfadjointView<Eigen::Upper>();
  return result;
}

void expect_same(const Model& native, const Model& expanded, const RateMap& map, const State& x) {
  const VectorXd v = map.G * x.v, a = map.G * x.a + map.drift;
  const Dynamics whole = dynamics(native, map.q, v, a);
  const Dynamics parts = dynamics(expanded, x.q, x.v, x.a);
  for (int engine = 0; engine < 2; ++engine) {
    EXPECT_LE(error(parts.tau[engine], map.G.transpose() * whole.tau[engine]), kTolerance);
    EXPECT_LE(error(parts.M[engine], map.G.transpose() * whole.M[engine] * map.G), kTolerance);
    EXPECT_LE(error(whole.M[engine], whole.M[engine].transpose()), 1e-14);  // rounding of sums
  }
  const auto expected = Reference(native).fk(map.q), actual = Reference(expanded).fk(x.q);
  for (size_t i = 0; i < native.links.size(); ++i)
    for (size_t k = 0; k < expanded.links.size(); ++k) {
      if (expanded.links[k].name != native.links[i].name) continue;
      EXPECT_LE(error(actual[k].R, expected[i].R), kTolerance);
      EXPECT_LE(error(actual[k].p, expected[i].p), kTolerance);
    }
}

Model reconfigured(const Model& model, ModelOptions options) {
  options.snap = 0;
  Diagnostics diagnostics;
  return configure(model, options, diagnostics);
}

template <class Check>
void for_random_models(RandomModelOptions options, Check check) {
  for (const std::uint64_t seed : seeds(kModels)) {
    options.base = seed % 2 ? Base::kFloating : Base::kFixed;
    const Model model = random_model(seed, options);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
    Random random(seed);
    check(model, random);
    if (testing::Test::HasFailure()) return;
  }
}

int count(const Model& model, JointType type) {
  int n = 0;
  for (const Joint& joint : model.joints) n += joint.type == type;
  return n;
}

TEST(JointTypes, PlanarFloatingAndSphericalOnesAreChainsOfAxes) {
  int planar = 0, floating = 0, spherical = 0;
  RandomModelOptions options;
  options.exotic = true;
  for_random_models(options, [&](const Model& native, Random& random) {
    ModelOptions how;
    how.expand = true;
    const Model expanded = reconfigured(native, how);
    EXPECT_EQ(coordinates(expanded).nv, coordinates(native).nv);
    const State x = random_state(expanded, random);
    expect_same(native, expanded, rate_map(native, x), x);
    planar += count(native, JointType::kPlanar);
    floating += count(native, JointType::kFloating);
    spherical += count(native, JointType::kSpherical);
  });
  EXPECT_GT(std::min({planar, floating, spherical}), 5);
}

Joint exotic(const std::string& name, JointType type, int parent) {
  Joint joint;
  joint.name = name;
  joint.type = type;
  joint.parent = parent;
  joint.child = parent + 1;
  joint.origin = {{0.3, -0.2, 0.1}, {0.4, 0.5, -0.6}};
  return joint;
}

/// A chain of what configure() splits: helical joints, one of which follows, universal, multi-axis.
Model split_chain() {
  Model model;
  model.name = "chain";
  model.root = 0;
  const Inertial inertial{{{0.1, 0.2, 0.3}, {}}, 1.5, {0.3, 0.4, 0.5, 0.01, 0.02, 0.03}, {}};
  for (const char* name : {"base", "a", "b", "c", "d"}) model.links.push_back({name, inertial, {}});
  for (const auto& [name, type] : {std::pair{"screw", JointType::kHelical},
                                   {"bolt", JointType::kHelical},
                                   {"cross", JointType::kUniversal},
                                   {"arm", JointType::kMultiAxis}})
    model.joints.push_back(exotic(name, type, static_cast<int>(model.joints.size())));
  model.joints[0].axis = {0.6, 0, 0.8};
  model.joints[0].pitch = 0.3;
  model.joints[0].mimic = Mimic{1, -1.5, 0.2};
  model.joints[1].axis = {0, -1, 0};
  model.joints[1].pitch = -0.7;
  model.joints[2].axes = {{false, {1, 0, 0}}, {false, {0, 0.8, 0.6}}};
  model.joints[3].axes = {{true, {0, 0, 1}}, {false, {0, 1, 0}, "swing"}, {true, {1, 0, 0}}};
  return model;
}

TEST(JointTypes, SplitJointsStandWhereLockedOnesStand) {
  const Model chain = split_chain();
  const Model split = reconfigured(chain, {});
  ASSERT_EQ(coordinates(split).nq, 6);
  std::string names;
  for (const Joint& joint : split.joints) names += joint.name + " ";
  EXPECT_EQ(names, "screw.slide screw bolt.slide bolt cross.1 cross.2 arm.1 arm.swing arm.3 ");
  for (const std::uint64_t seed : seeds(20)) {
    Random random(seed);
    const VectorXd q = random.vector(6, 2);
    ModelOptions how;
    how.locks = {{"bolt", {q[0]}}, {"cross", {q[1], q[2]}}, {"arm", {q[3], q[4], q[5]}}};
    const Model locked = reconfigured(chain, how);
    ASSERT_EQ(coordinates(locked).nq, 0);
    const auto expected = Reference(locked).fk(VectorXd(0)), actual = Reference(split).fk(q);
    for (size_t i = 0; i < locked.links.size(); ++i)
      for (size_t k = 0; k < split.links.size(); ++k) {
        if (split.links[k].name != locked.links[i].name) continue;
        EXPECT_LE(error(actual[k].R, expected[i].R), kTolerance);
        EXPECT_LE(error(actual[k].p, expected[i].p), kTolerance);
      }
  }
}

TEST(JointTypes, DerivativesAreThoseOfTheReference) {
  RandomModelOptions options;
  options.exotic = true;
  for_random_models(options, [](const Model& model, Random& random) {
    const State s = random_state(model, random);
    const int n = static_cast<int>(s.v.size());
    if (n == 0) return;
    const ComplexReference reference(model);
    const arboc::State at{s.q, s.v, s.a, {}};
    const auto inverse = [](const auto& r, const auto& x) { return r.rnea(x.q, x.v, x.a); };
    const DynamicTree tree = lower(model, {FrameChoice::kDenavit, true});
    RneaDerivativesWorkspace<double> work(tree);
    RowMajor dq = RowMajor::Zero(n, n), dv = dq, M = dq;
    rnea_derivatives(tree, work, s.q.data(), s.v.data(), s.a.data(),
                     SquareMatrix<double>{dq.data(), n}, SquareMatrix<double>{dv.data(), n},
                     UpperTriangle<double>{M.data(), n});
    EXPECT_LE(error(dq, differentiate(reference, inverse, at, With::kQ)), kTolerance);
    EXPECT_LE(error(dv, differentiate(reference, inverse, at, With::kV)), kTolerance);
  });
}

TEST(JointTypes, MovementsAreThoseOfTheReference) {
  RandomModelOptions options;
  options.exotic = true;
  for_random_models(options, [](const Model& model, Random& random) {
    const VectorXd q = random_state(model, random).q, step = random_state(model, random).v / 4;
    const auto n = step.size();
    const Reference reference(model);
    const DynamicTree tree = lower(model, {FrameChoice::kAxis, false});
    VectorXd moved(q.size()), back(n);
    integrate(tree, q.data(), step.data(), moved.data());
    EXPECT_LE(error(moved, reference.integrate(q, step)), kTolerance);
    difference(tree, q.data(), moved.data(), back.data());
    EXPECT_LE(error(back, step), kTolerance);
    EXPECT_LE(error(reference.difference(q, moved), step), kTolerance);

    const ComplexReference complex(model);
    const VectorOf<Complex> at = q.cast<Complex>(), to = moved.cast<Complex>();
    const auto tangent = [&](const auto& f) {
      MatrixXd J(n, n);
      for (Eigen::Index k = 0; k < n; ++k) {
        const VectorOf<Complex> d = VectorOf<Complex>::Unit(n, k) * Complex(0, 1e-30);
        J.col(k) = f(d).imag() / 1e-30;
      }
      return J;
    };
    RowMajor d0(n, n), d1(n, n);
    difference_derivatives(tree, q.data(), moved.data(), d0.data(), d1.data());
    EXPECT_LE(error(d0, tangent([&](const auto& d) {
                      return complex.difference(complex.integrate(at, d), to);
                    })),
              kTolerance);
    EXPECT_LE(error(d1, tangent([&](const auto& d) {
                      return complex.difference(at, complex.integrate(to, d));
                    })),
              kTolerance);
    RowMajor by_q(n, n), by_v(n, n);
    integrate_derivatives(tree, q.data(), step.data(), by_q.data(), by_v.data());
    const VectorOf<Complex> way = step.cast<Complex>();
    EXPECT_LE(error(by_q, tangent([&](const auto& d) {
                      return complex.difference(to,
                                                complex.integrate(complex.integrate(at, d), way));
                    })),
              kTolerance);
    EXPECT_LE(error(by_v, tangent([&](const auto& d) {
                      return complex.difference(to,
                                                complex.integrate(at, VectorOf<Complex>(way + d)));
                    })),
              kTolerance);
  });
}

TEST(JointTypes, RegroupingTakesWhatMovesLikeTheParent) {
  int spherical = 0;
  RandomModelOptions options;
  options.exotic = true;
  for_random_models(options, [&](const Model& model, Random&) {
    for (const BodyOf<double>& body : lower(model, {FrameChoice::kDenavit, true}).body) {
      if (body.motion == Motion::kSpherical) {
        EXPECT_EQ(body.inertia.m, 0);
        ++spherical;
      }
    }
  });
  EXPECT_GT(spherical, 5);
}

TEST(JointTypes, CosineAndSineStandForTheAngle) {
  int unbounded = 0;
  for_random_models({}, [&](const Model& angles, Random& random) {
    ModelOptions how;
    how.continuous = ContinuousAs::kCosSin;
    const Model circles = reconfigured(angles, how);
    const State x = random_state(angles, random);
    const Coordinates from = coordinates(angles), to = coordinates(circles);
    VectorXd q(to.nq);
    for (size_t k = 0; k < angles.joints.size(); ++k) {
      const Joint& joint = angles.joints[k];
      if (nv(joint) == 0 || joint.mimic) continue;
      auto own = q.segment(to.joint[k].q, nq(circles.joints[k]));
      own.head(nq(joint)) = x.q.segment(from.joint[k].q, nq(joint));
      if (circles.joints[k].type != JointType::kUnbounded) continue;
      own = Eigen::Vector2d(std::cos(own[0]), std::sin(own[0]));
      ++unbounded;
    }
    const auto n = x.v.size();
    expect_same(circles, angles, {q, MatrixXd::Identity(n, n), VectorXd::Zero(n)}, x);
  });
  EXPECT_GT(unbounded, 20);
}

}  // namespace
}  // namespace arboc::test

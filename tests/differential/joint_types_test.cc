// Joints of several freedoms against what they are made of: the same places, and forces and
// inertias that the map of rates carries over, in the reference and in the generic engine.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "algorithms/scalar_double.h"
#include "functions/catalogue.h"
#include "record.h"
#include "reference/reference.h"
#include "support/dual.h"
#include "support/random_model.h"
#include "support/random_state.h"

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

RateMap rate_map(const Model& native, const Model& expanded, const State& x) {
  const Coordinates to = coordinates(native), from = coordinates(expanded);
  RateMap map{VectorXd(to.nq), MatrixXd::Identity(to.nv, to.nv), VectorXd::Zero(to.nv)};
  for (size_t k = 0; k < native.joints.size(); ++k) {
    const Joint& joint = native.joints[k];
    if (nv(joint) == 0 || joint.mimic) continue;
    const int n = nv(joint), at = to.joint[k].v;
    const VectorXd q = x.q.segment(from.joint[k].q, nq(expanded.joints[k]));
    const VectorXd v = x.v.segment(from.joint[k].v, n);
    map.q.segment(to.joint[k].q, nq(joint)) = native_q(joint, q);
    if (expanded.joints[k].type == joint.type) continue;
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

std::vector<double> list(const VectorXd& x) { return {x.begin(), x.end()}; }

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
  const Values in{{"q", list(q)}, {"v", list(v)}, {"a", list(a)}};
  const auto tau = evaluate_generic("rnea", tree, in).at("tau");
  const auto M = evaluate_generic("crba", tree, in).at("M");
  result.tau[1] = Eigen::Map<const VectorXd>(tau.data(), tree.nv);
  result.M[1] = Eigen::Map<const MatrixXd>(M.data(), tree.nv, tree.nv);
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
    expect_same(native, expanded, rate_map(native, expanded, x), x);
    planar += count(native, JointType::kPlanar);
    floating += count(native, JointType::kFloating);
    spherical += count(native, JointType::kSpherical);
  });
  EXPECT_GT(std::min({planar, floating, spherical}), 5);
}

/// Adds a massless link between the joint's parent and child; the joint moves it, and a copy of the
/// joint, placed there, moves the child.
Joint& split(Model& model, size_t k) {
  Joint rest = model.joints[k];
  const int between = static_cast<int>(model.links.size());
  model.links.push_back({rest.name + " " + std::to_string(between), {}, {}});
  model.joints[k].child = between;
  rest.name += "'";
  rest.parent = between;
  rest.origin = {};
  model.joints.push_back(rest);
  return model.joints.back();
}

TEST(JointTypes, HelicalOnesAreTurnsAndSlidesThatFollow) {
  int helical = 0;
  RandomModelOptions options;
  options.exotic = true;
  for_random_models(options, [&](const Model& native, Random& random) {
    Model parts = native;
    for (size_t k = 0; k < native.joints.size(); ++k) {
      if (native.joints[k].type != JointType::kHelical) continue;
      Joint& slide = split(parts, k);
      slide.type = JointType::kPrismatic;
      slide.mimic = Mimic{static_cast<int>(k), slide.pitch, 0};
      parts.joints[k].type = JointType::kRevolute;
      ++helical;
    }
    parts = reconfigured(parts, {});
    const State x = random_state(native, random);
    const auto n = x.v.size();
    expect_same(native, parts, {x.q, MatrixXd::Identity(n, n), VectorXd::Zero(n)}, x);
  });
  EXPECT_GT(helical, 5);
}

TEST(JointTypes, UniversalAndMultiAxisOnesAreChainsOfJoints) {
  int universal = 0, multi = 0;
  RandomModelOptions options;
  options.exotic = true;
  options.mimic = false;
  for_random_models(options, [&](const Model& native, Random& random) {
    Model parts = native;
    const auto make = [](Joint& joint, const JointAxis& axis) {
      joint.type = axis.prismatic ? JointType::kPrismatic : JointType::kRevolute;
      joint.axis = axis.axis;
      joint.axes.clear();
    };
    for (size_t k = 0; k < native.joints.size(); ++k) {
      const std::vector<JointAxis>& axes = native.joints[k].axes;
      size_t last = k;
      for (size_t i = 0; i < axes.size(); ++i) {
        if (i + 1 < axes.size()) split(parts, last);
        make(parts.joints[last], axes[i]);
        last = parts.joints.size() - 1;
      }
      universal += native.joints[k].type == JointType::kUniversal;
      multi += native.joints[k].type == JointType::kMultiAxis;
    }
    parts = reconfigured(parts, {});
    const State x = random_state(native, random);
    const auto n = x.v.size();
    expect_same(native, parts, {x.q, MatrixXd::Identity(n, n), VectorXd::Zero(n)}, x);
  });
  EXPECT_GT(std::min(universal, multi), 5);
}

TEST(JointTypes, RegroupingTakesWhatMovesLikeTheParent) {
  int spherical = 0, helical = 0;
  RandomModelOptions options;
  options.exotic = true;
  for_random_models(options, [&](const Model& model, Random&) {
    for (const BodyOf<double>& body : lower(model, {FrameChoice::kDenavit, true}).body) {
      if (body.motion == Motion::kSpherical) {
        EXPECT_EQ(body.inertia.m, 0);
        ++spherical;
      }
      if (body.motion == Motion::kHelical) {
        EXPECT_EQ(body.inertia.Sigma.zz, 0);
        ++helical;
      }
    }
  });
  EXPECT_GT(std::min(spherical, helical), 5);
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

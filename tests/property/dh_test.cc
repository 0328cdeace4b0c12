// DH tables: rows, joints of several axes, the human, its anthropometry and its roots, against
// transformations multiplied out here and against the numbers of the documents.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "frontend/dh.h"
#include "frontend/dh_file.h"
#include "frontend/read_model.h"
#include "functions/setup.h"
#include "reference/frames.h"
#include "reference/reference.h"
#include "support/random.h"
#include "tree/numbering.h"

namespace arboc::test {
namespace {

/// One of low .. high.
int pick(Random& random, int low, int high) { return low + random.integer(high - low + 1); }

constexpr const char* kSantos = ARBOC_SOURCE_DIR "/models/santos/santos.dh.toml";
using Eigen::Isometry3d, Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;

Model configured(const Model& model, const ModelOptions& options = {}) {
  Diagnostics diagnostics;
  return configure(model, options, diagnostics);
}
Model parsed(const std::string& text) {
  Diagnostics diagnostics;
  return parse_dh(text, "test.dh.toml", "", diagnostics);
}
Model santos(const ModelOptions& options = {}, const std::string& anthropometry = "") {
  Diagnostics diagnostics;
  return configured(read_model(kSantos, diagnostics, anthropometry), options);
}

ModelOptions with_base(Base base, const std::string& hang_from = "") {
  ModelOptions options;
  options.base = base;
  options.hang_from = hang_from;
  return options;
}
ModelOptions unsnapped() {
  ModelOptions options;
  options.snap = 0;
  return options;
}

size_t link_of(const Model& model, const std::string& name) {
  for (size_t k = 0; k < model.links.size(); ++k)
    if (model.links[k].name == name) return k;
  throw std::invalid_argument("no link " + name);
}
int q_of(const Model& model, const std::string& joint) {
  const Coordinates at = coordinates(model);
  for (size_t k = 0; k < model.joints.size(); ++k)
    if (model.joints[k].name == joint) return at.joint[k].q;
  throw std::invalid_argument("no joint " + joint);
}

Isometry3d place(const Model& model, const VectorXd& q, const std::string& link) {
  const auto p = Reference(model).fk(q)[link_of(model, link)];
  Isometry3d T = Isometry3d::Identity();
  T.linear() = p.R;
  T.translation() = p.p;
  return T;
}

VectorXd random_vector(int n, Random& random, double size = 1.5) {
  VectorXd x(n);
  for (int k = 0; k < n; ++k) x[k] = random.uniform(-size, size);
  return x;
}

double apart(const Isometry3d& a, const Isometry3d& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

Isometry3d turn(const Vector3d& axis, double angle) {
  return Isometry3d(Eigen::AngleAxisd(angle, axis));
}
Isometry3d slide(const Vector3d& by) { return Isometry3d(Eigen::Translation3d(by)); }

Isometry3d row(bool modified, double theta, double d, double alpha, double a) {
  const Vector3d x = Vector3d::UnitX(), z = Vector3d::UnitZ();
  return modified ? turn(x, alpha) * slide(a * x) * turn(z, theta) * slide(d * z)
                  : turn(z, theta) * slide(d * z) * slide(a * x) * turn(x, alpha);
}

// Rows of any kind: turning, sliding, fixed, sharing a joint or following it, on any parent.
TEST(DhRows, EqualTheirTransformationsMultipliedOut) {
  for (const std::uint64_t seed : seeds(20)) {
    Random random(seed);
    const bool modified = seed % 2 == 0;
    struct Row {
      int parent, joint, kind;  // kind: 0 turns, 1 slides, 2 fixed
      double factor, theta, d, alpha, a;
    };
    std::vector<Row> rows;
    std::string joints, text;
    const int n = 8;
    std::vector<int> kind_of_joint;
    for (int k = 0; k < n; ++k) {
      Row r{k == 0 ? -1 : pick(random, -1, k - 1), -1, pick(random, 0, 2), 1, 0, 0, 0, 0};
      r.theta = pick(random, 0, 1) ? random.uniform(-3, 3) : 0;
      r.d = pick(random, 0, 1) ? random.uniform(-1, 1) : 0;
      r.alpha = pick(random, 0, 2) * M_PI / 2;
      r.a = pick(random, 0, 1) ? random.uniform(-1, 1) : 0;
      if (r.kind < 2) {
        int shared = -1;
        for (size_t j = 0; j < kind_of_joint.size(); ++j)
          if (kind_of_joint[j] == r.kind && pick(random, 0, 1)) shared = static_cast<int>(j);
        if (shared < 0) {
          shared = static_cast<int>(kind_of_joint.size());
          kind_of_joint.push_back(r.kind);
          joints += fmt::format("q{} = {{}}\n", shared);
          r.factor = pick(random, 0, 1) ? 1 : -1;
        } else {
          r.factor = pick(random, 0, 1) ? 1 : random.uniform(-2, 2);
        }
        r.joint = shared;
      }
      const std::string q = r.joint < 0 ? "" : fmt::format("{} * q{} + ", r.factor, r.joint);
      text += fmt::format(
          "[[frames]]\nname = \"f{}\"\nparent = \"{}\"\ntheta = \"{}{}\"\nd = \"{}{}\"\n"
          "alpha = {}\na = {}\n",
          k, r.parent < 0 ? "base" : fmt::format("f{}", r.parent), r.kind == 0 ? q : "", r.theta,
          r.kind == 1 ? q : "", r.d, r.alpha, r.a);
      rows.push_back(r);
    }
    const Model model = configured(
        parsed(fmt::format("name = \"n\"\nconvention = \"{}\"\nunits = {{ length = \"m\", angle = "
                           "\"rad\" }}\n[joints]\n{}{}",
                           modified ? "modified" : "standard", joints, text)),
        unsnapped());
    SCOPED_TRACE(text);
    const VectorXd q = random_vector(coordinates(model).nq, random);
    std::vector<Isometry3d> T;
    for (const Row& r : rows) {
      double x = 0;
      if (r.joint >= 0) x = r.factor * q[q_of(model, fmt::format("q{}", r.joint))];
      const Isometry3d own =
          row(modified, r.theta + (r.kind == 0 ? x : 0), r.d + (r.kind == 1 ? x : 0), r.alpha, r.a);
      T.push_back(r.parent < 0 ? own : T[static_cast<size_t>(r.parent)] * own);
    }
    for (int k = 0; k < n; ++k)
      EXPECT_LT(apart(place(model, q, fmt::format("f{}", k)), T[static_cast<size_t>(k)]), 1e-13);
  }
}

// The same numbers mean two arms; both in closed form.
TEST(DhRows, ConventionsOfAPlanarArm) {
  const std::string rows =
      "[joints]\nq1 = {}\nq2 = {}\n[[frames]]\nname = \"f1\"\ntheta = \"q1\"\nd = 0\nalpha = "
      "0\na = 0.5\n[[frames]]\nname = \"f2\"\ntheta = \"q2\"\nd = 0\nalpha = 0\na = 0.25\n";
  const VectorXd q = Eigen::Vector2d(0.3, -0.8);
  const std::string head =
      "name = \"n\"\nunits = { length = \"m\", angle = \"rad\" }\nconvention = \"";
  const Model standard = configured(parsed(head + "standard\"\n" + rows));
  const Model modified = configured(parsed(head + "modified\"\n" + rows));
  const Vector3d tip = place(standard, q, "f2").translation();
  EXPECT_NEAR(tip.x(), 0.5 * std::cos(0.3) + 0.25 * std::cos(-0.5), 1e-15);
  EXPECT_NEAR(tip.y(), 0.5 * std::sin(0.3) + 0.25 * std::sin(-0.5), 1e-15);
  const Vector3d wrist = place(modified, q, "f2").translation();
  EXPECT_NEAR(wrist.x(), 0.5 + 0.25 * std::cos(0.3), 1e-15);
  EXPECT_NEAR(wrist.y(), 0.25 * std::sin(0.3), 1e-15);
}

// Three orders of one axis, six of two, six of three ([Astronaut] section 2).
TEST(LocalFrames, OfAllOrdersOfAxes) {
  std::vector<std::string> orders;
  const std::string letters = "XYZ";
  for (const char a : letters) {
    orders.push_back({a});
    for (const char b : letters)
      if (b != a) {
        orders.push_back({a, b});
        for (const char c : letters)
          if (c != a && c != b) orders.push_back({a, b, c});
      }
  }
  ASSERT_EQ(orders.size(), 15u);
  Random random(1);
  for (const std::string& axes : orders) {
    SCOPED_TRACE(axes);
    const auto local = local_frames(axes);
    std::vector<Matrix3d> Q;
    for (size_t k = 0; k < local.size(); ++k) {
      Matrix3d& own = Q.emplace_back();
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) own(i, j) = local[k](i, j);
      EXPECT_EQ(own.col(2), Vector3d::Unit(axes[k] - 'X'));
      EXPECT_EQ(own.col(0).cross(own.col(1)), own.col(2));
      const Matrix3d step = k == 0 ? own : Matrix3d(Q[k - 1].transpose() * own);
      const double cosine = (step.trace() - 1) / 2;
      EXPECT_EQ(cosine, axes[k] == 'Z' && k == 0 ? 1 : 0);  // a quarter turn, or none
    }
    const Model model = configured(parsed(fmt::format(
        "name = \"n\"\nunits = {{ length = \"m\", angle = \"rad\" }}\n[joints]\nj = {{ axes = "
        "\"{}\" }}\n[[frames]]\nname = \"f\"\njoint = \"j\"\nxyz = [0.1, 0.2, 0.3]\n",
        axes)));
    const VectorXd q = random_vector(static_cast<int>(axes.size()), random);
    Isometry3d T = slide({0.1, 0.2, 0.3});
    for (size_t k = 0; k < axes.size(); ++k)
      T = T * turn(Vector3d::Unit(axes[k] - 'X'), q[static_cast<int>(k)]);
    EXPECT_LT(apart(place(model, q, "f.private"), T), 1e-15);
    T.linear() = T.linear() * Q.back();
    EXPECT_LT(apart(place(model, q, "f"), T), 1e-15);
    int dummies = 0;
    for (const NumberedLink& link : number_links(model)) dummies += link.dummy ? 1 : 0;
    EXPECT_EQ(dummies, static_cast<int>(axes.size()));  // this model has no masses
  }
}

// [Thesis] Tables A.4 to A.8 with Table A.1, at zero, in the frame of the hips.
TEST(Santos, StandsAsItsTablesSay) {
  const Model model = santos();
  const VectorXd zero = VectorXd::Zero(55);
  const Isometry3d to_base = place(model, zero, "base").inverse();
  const auto at = [&](const char* link) -> Vector3d {
    return (to_base * place(model, zero, link)).translation();
  };
  const double kPrinted = 1e-4;  // four digits
  EXPECT_LT((at("z19") - Vector3d(0.0558, -0.6565, 0.3310)).norm(), kPrinted);
  EXPECT_LT((at("z29") - Vector3d(0.0558, 0.6565, 0.3310)).norm(), kPrinted);
  EXPECT_LT((at("z35") - Vector3d(0, 0, 0.4587)).norm(), kPrinted);
  EXPECT_LT((at("z42") - Vector3d(0, -0.0803, -0.8658)).norm(), kPrinted);
  EXPECT_LT((at("r_ball") - Vector3d(0.1306, -0.0803, -0.8658)).norm(), kPrinted);
  // World: x left, y up, z forward.
  EXPECT_LT((place(model, zero, "l_ball").translation() - Vector3d(0.0803, -0.8658, 0.1306)).norm(),
            kPrinted);
  EXPECT_EQ(coordinates(model).nv, 55);
  int rows = 0;
  for (const Link& link : model.links) rows += link.reported ? 1 : 0;
  EXPECT_EQ(rows, 54);
}

TEST(Santos, WeighsWhatItsTableSays) {
  const Model model = santos();
  double mass = 0;
  for (const Link& link : model.links) mass += link.inertial ? link.inertial->mass : 0;
  EXPECT_NEAR(mass, 98.3, 1e-12);
  Random random(1);
  const Reference reference(model);
  for (int k = 0; k < 20; ++k) {
    const VectorXd g = reference.gravity(random_vector(55, random));
    EXPECT_NEAR(g[1], 98.3 * 9.81, 1e-9);  // 964.32 N upwards, in any posture
    EXPECT_NEAR(g[0], 0, 1e-9);
    EXPECT_NEAR(g[2], 0, 1e-9);
  }
}

// The first rows by which the document turns the body: theta = q + pi/2, alpha = pi/2, three times.
TEST(Santos, TurnsLikeTheRowsOfTheDocument) {
  const Model model = santos();
  Random random(1);
  const VectorXd q = random_vector(55, random);
  Isometry3d T = slide(q.head<3>());
  for (int k = 3; k < 6; ++k) T = T * row(false, q[k] + M_PI / 2, 0, M_PI / 2, 0);
  EXPECT_LT(apart(place(model, q, "z0"), T), 1e-14);
  const Isometry3d R =
      turn(Vector3d::UnitZ(), q[3]) * turn(Vector3d::UnitX(), q[4]) * turn(Vector3d::UnitY(), q[5]);
  EXPECT_LT(apart(place(model, q, "z0"), slide(q.head<3>()) * R), 1e-14);
}

TEST(Santos, OneJointTurnsBothArmsAndTheHead) {
  const Model model = santos();
  const int q12 = q_of(model, "q12");
  VectorXd q = VectorXd::Zero(55);
  q[q12] = 0.2;
  for (const char* link : {"r_hand", "l_hand", "head"})
    EXPECT_GT(apart(place(model, q, link), place(model, VectorXd::Zero(55), link)), 0.01) << link;
}

// A person s times as large: lengths s, first moments s, inertias s^2 at the same masses.
TEST(Santos, ScalesWithItsLengths) {
  const double s = 1.1;
  const Model model = santos();
  FunctionOptions options;
  options.parameters = {"lengths", "cgs", "inertias"};
  const auto setup = resolve(model, options);
  std::vector<std::vector<double>> values;
  for (const Parameter& p : setup.parameters) {
    values.push_back(p.nominal);
    for (double& x : values.back()) x *= p.kind == Parameter::Kind::kInertia ? s * s : s;
  }
  EXPECT_EQ(setup.parameters.back().name, "lengths");
  EXPECT_EQ(values.back().size(), 26u);
  const Model scaled = model_with(model, setup.parameters, values);
  Random random(1);
  VectorXd q = random_vector(55, random);
  q.head<3>().setZero();
  for (const char* link :
       {"z21", "z31", "z37", "z45", "z53"})  // points at fixed places do not scale
    EXPECT_LT(
        (place(scaled, q, link).translation() - s * place(model, q, link).translation()).norm(),
        1e-14);
  const MatrixXd M = Reference(model).crba(q), N = Reference(scaled).crba(q);
  for (int i = 3; i < 55; ++i)
    for (int j = 3; j < 55; ++j) EXPECT_NEAR(N(i, j), s * s * M(i, j), 1e-12 * M(3, 3));
}

// Reading other lengths and putting them in as parameters are the same.
TEST(Santos, AnthropometryOfAFileEqualsParameters) {
  const std::string path = testing::TempDir() + "/tall.toml";
  FILE* file = std::fopen(path.c_str(), "w");
  std::fputs(
      "units = { length = \"cm\", angle = \"rad\", mass = \"g\" }\n[lengths]\nL19 = 45\nL24 = "
      "45\n[segments]\n\"Head\" = { mass = 7000 }\n",
      file);
  std::fclose(file);
  const Model tall = santos({}, path);
  const Model model = santos();
  FunctionOptions options;
  options.parameters = {"lengths:L19", "lengths:L24", "masses:Head"};
  const auto setup = resolve(model, options);
  const Model same = model_with(model, setup.parameters, {{7}, {0.45, 0.45}});
  Random random(1);
  const VectorXd q = random_vector(55, random);
  EXPECT_EQ(place(tall, q, "r_ball").matrix(), place(same, q, "r_ball").matrix());
  EXPECT_EQ(Reference(tall).crba(q), Reference(same).crba(q));
  EXPECT_NE(tall.source_sha256, model.source_sha256);
}

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

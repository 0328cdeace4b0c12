// Rows of DH tables and joints of several axes, against transformations multiplied out here.
#include <fmt/format.h>

#include "frontend/dh_file.h"
#include "property/dh_support.h"
#include "tree/numbering.h"

namespace arboc::test {
namespace {

/// One of low .. high.
int pick(Random& random, int low, int high) { return low + random.integer(high - low + 1); }

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

}  // namespace
}  // namespace arboc::test

// --lock, --root and --tip leave the dynamics of what stays as they were.
#include <gtest/gtest.h>

#include <algorithm>

#include "reference/eigen.h"
#include "reference/reference.h"
#include "support/random_model.h"
#include "support/random_state.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kModels = 40;
constexpr double kTolerance = 1e-12;  // rounding of sums over the tree

size_t index_of(const Model& model, const std::string& joint) {
  const auto found = std::find_if(model.joints.begin(), model.joints.end(),
                                  [&](const Joint& j) { return j.name == joint; });
  return static_cast<size_t>(found - model.joints.begin());
}

size_t link_index(const Model& model, const std::string& link) {
  const auto found = std::find_if(model.links.begin(), model.links.end(),
                                  [&](const Link& l) { return l.name == link; });
  return static_cast<size_t>(found - model.links.begin());
}

/// Which coordinates of `whole` those of `part` are.
struct Selection {
  std::vector<int> q, v;
};
Selection selection(const Model& whole, const Model& part) {
  const Coordinates in_whole = coordinates(whole), in_part = coordinates(part);
  Selection result{std::vector<int>(static_cast<size_t>(in_part.nq)),
                   std::vector<int>(static_cast<size_t>(in_part.nv))};
  for (size_t k = 0; k < part.joints.size(); ++k) {
    const Joint& joint = part.joints[k];
    if (nv(joint.type) == 0 || joint.mimic) continue;
    const auto& from = in_whole.joint[index_of(whole, joint.name)];
    for (int i = 0; i < nq(joint.type); ++i)
      result.q[static_cast<size_t>(in_part.joint[k].q + i)] = from.q + i;
    for (int i = 0; i < nv(joint.type); ++i)
      result.v[static_cast<size_t>(in_part.joint[k].v + i)] = from.v + i;
  }
  return result;
}

/// `x` with zeros where `kept` does not choose.
VectorXd only(const VectorXd& x, const std::vector<int>& kept) {
  VectorXd result = VectorXd::Zero(x.size());
  for (const int i : kept) result[i] = x[i];
  return result;
}

double error(const MatrixXd& actual, const MatrixXd& expected) {
  if (expected.size() == 0) return 0;
  return (actual - expected).cwiseAbs().maxCoeff() / std::max(1.0, expected.cwiseAbs().maxCoeff());
}

void expect_same_dynamics(const Model& whole, const Model& part, const State& x) {
  const Reference all(whole), some(part);
  const auto [q, v] = selection(whole, part);
  const VectorXd qs = x.q(q), vs = x.v(v), as = x.a(v);
  EXPECT_LE(error(some.crba(qs), all.crba(x.q)(v, v)), kTolerance);
  const VectorXd tau = all.rnea(x.q, only(x.v, v), only(x.a, v));
  EXPECT_LE(error(some.rnea(qs, vs, as), tau(v)), kTolerance);
}

Model model_of(std::uint64_t seed, bool mimic, Base base, bool exotic) {
  RandomModelOptions options;
  options.mimic = mimic;
  options.base = base;
  options.exotic = exotic;
  return random_model(seed, options);
}

class ModelOptionsTest : public testing::TestWithParam<Base> {};

TEST_P(ModelOptionsTest, LockedJointsStandWhereTheyAreLocked) {
  int locked_joints = 0;
  for (const std::uint64_t seed : seeds(kModels)) {
    const Model model = model_of(seed, true, GetParam(), seed % 2 == 1);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
    Random random(seed);
    const State x = random_state(model, random);
    const Coordinates at = coordinates(model);
    ModelOptions how;
    how.snap = 0;
    for (size_t k = 0; k < model.joints.size(); ++k) {
      const Joint& joint = model.joints[k];
      if (nv(joint.type) == 0 || joint.mimic || random.chance(0.5)) continue;
      const VectorXd q = x.q.segment(at.joint[k].q, nq(joint.type));
      how.locks.push_back({joint.name, {q.data(), q.data() + q.size()}});
      ++locked_joints;
    }
    Diagnostics diagnostics;
    const Model locked = configure(model, how, diagnostics);
    ASSERT_EQ(locked.links.size(), model.links.size());
    expect_same_dynamics(model, locked, x);
    const auto expected = Reference(model).fk(x.q);
    const auto actual = Reference(locked).fk(x.q(selection(model, locked).q));
    for (size_t i = 0; i < expected.size(); ++i) {
      EXPECT_LE(error(actual[i].R, expected[i].R), kTolerance);
      EXPECT_LE(error(actual[i].p, expected[i].p), kTolerance);
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(locked_joints, kModels);
}

TEST_P(ModelOptionsTest, SubchainsKeepTheirDynamics) {
  size_t dropped = 0, moving = 0;
  for (const std::uint64_t seed : seeds(kModels)) {
    Model model = model_of(seed, false, GetParam(), false);
    SCOPED_TRACE("ARBOC_SEED=" + std::to_string(seed) + "\n" + print(model));
    Random random(seed);
    const State x = random_state(model, random);
    ModelOptions how;
    how.snap = 0;
    const auto root = static_cast<size_t>(random.integer(3));
    how.root = model.links[root].name;
    size_t tip = root;  // the root, or by several steps something behind it
    for (const Joint& joint : model.joints)
      if (joint.parent == static_cast<int>(tip) && random.chance(0.8))
        tip = static_cast<size_t>(joint.child);
    how.tips = {model.links[tip].name};
    Diagnostics diagnostics;
    const Model part = configure(model, how, diagnostics);
    EXPECT_EQ(part.links[0].name, how.root);
    EXPECT_LT(link_index(part, how.tips[0]), part.links.size());

    dropped += model.links.size() - part.links.size();
    moving += static_cast<size_t>(coordinates(part).nv);
    // What was dropped weighs nothing, and gravity is that of the subchain's root.
    const Eigen::Vector3d g = Reference(model).fk(x.q)[root].R * to_eigen(model.gravity);
    model.gravity = {g[0], g[1], g[2]};
    for (Link& link : model.links)
      if (link_index(part, link.name) == part.links.size()) link.inertial.reset();
    if (root != 0 || GetParam() == Base::kFixed) expect_same_dynamics(model, part, x);
    if (HasFailure()) return;
  }
  EXPECT_GT(dropped, static_cast<size_t>(kModels));
  EXPECT_GT(moving, static_cast<size_t>(kModels));
}

INSTANTIATE_TEST_SUITE_P(Bases, ModelOptionsTest, testing::Values(Base::kFixed, Base::kFloating),
                         [](const auto& base) {
                           return base.param == Base::kFixed ? "Fixed" : "Floating";
                         });

Model arm() {
  Model model;
  model.root = 0;
  model.file = "arm.urdf";
  for (const char* name : {"base", "upper", "lower", "hand", "tool", "finger"})
    model.links.push_back({name, Inertial{}, {}});
  const auto add = [&](const char* name, JointType type, int parent, int child) {
    Joint joint;
    joint.name = name;
    joint.type = type;
    joint.parent = parent;
    joint.child = child;
    model.joints.push_back(joint);
  };
  add("shoulder", JointType::kRevolute, 0, 1);
  add("elbow", JointType::kContinuous, 1, 2);
  add("wrist", JointType::kRevolute, 2, 3);
  add("mount", JointType::kFixed, 3, 4);
  add("grip", JointType::kPrismatic, 4, 5);
  model.joints[2].mimic = Mimic{1, -2, 0.25};
  model.joints[0].limits = {-1, 1};
  model.links[5].inertial->mass = 3;
  return model;
}

Model configured(const ModelOptions& options, std::string& said) {
  Diagnostics diagnostics;
  Model model = configure(arm(), options, diagnostics);
  for (const Diagnostic& d : diagnostics.all()) said += to_string(d) + "\n";
  return model;
}

TEST(ModelOptions, QuarterTurnsAreExact) {
  ModelOptions options;
  options.locks = {{"elbow", {1.5707963267948966}}, {"shoulder", {1.25}}, {"grip", {0.5}}};
  std::string said;
  const Model model = configured(options, said);
  EXPECT_EQ(said,
            "arm.urdf: warning: joint 'shoulder': locked at 1.25, beyond its limits -1 and 1\n"
            "arm.urdf: note: joint 'wrist': follows a locked joint: locked at "
            "-2.891592653589793\n");
  const Matrix3<double> R = rotation(model.joints[1].origin);
  const double expected[3][3] = {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_EQ(R(i, j), expected[i][j]);
  EXPECT_EQ(model.joints[4].origin.xyz.x, 0.5);
  EXPECT_EQ(coordinates(model).nv, 0);
}

TEST(ModelOptions, SubchainsEndBehindWhatIsWeldedToTheirTips) {
  ModelOptions options;
  options.root = "upper";
  options.tips = {"hand"};
  std::string said;
  const Model model = configured(options, said);
  EXPECT_EQ(said,
            "arm.urdf: note: link 'upper': subchain from here: left out are 2 links with 3 kg, and "
            "2 joints of which 2 move\n");
  ASSERT_EQ(model.links.size(), 4u);
  EXPECT_EQ(model.links[3].name, "tool");
  ASSERT_EQ(model.joints.size(), 3u);
  EXPECT_EQ(model.joints[1].mimic->leader, 0);
}

TEST(ModelOptions, FollowersNeedTheirLeaders) {
  ModelOptions options;
  options.root = "lower";
  std::string said;
  try {
    configured(options, said);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(),
                 "arm.urdf: error: joint 'wrist': <mimic>: follows joint 'elbow', which --root or "
                 "--tip cuts off (keep that one, hold it by --lock, or use --mimic independent)");
  }
  options.mimic = MimicPolicy::kIndependent;
  EXPECT_EQ(coordinates(configured(options, said)).nv, 2);
  options.mimic = MimicPolicy::kFollow;
  options.locks = {{"elbow", {0}}};
  EXPECT_EQ(coordinates(configured(options, said)).nv, 1);
}

}  // namespace
}  // namespace arboc::test

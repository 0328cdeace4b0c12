// The shapes that lowering promises: zeros, exact quarter turns, patterns, linear time.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/exact_trig.h"
#include "tree/axis_frames.h"
#include "tree/coupling.h"
#include "tree/factor.h"
#include "tree/lower.h"
#include "tree/mass_moments.h"
#include "tree/merge_fixed.h"
#include "tree/tallied.h"
#include "tree_models.h"

namespace arboc::test {
namespace {

double difference(const Matrix3<double>& A, const Matrix3<double>& B) {
  double worst = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) worst = std::max(worst, std::fabs(A(i, j) - B(i, j)));
  return worst;
}

bool quarter(const Turn& turn) {
  return (turn.c == 0 && std::fabs(turn.s) == 1) || (turn.s == 0 && std::fabs(turn.c) == 1);
}

TEST(Factor, SignedPermutationsAreExactQuarterTurns) {
  for (long i = 0; i < 64; ++i) {
    const Pose pose{{},
                    {degrees15(6 * (i % 4)), degrees15(6 * (i / 4 % 4)), degrees15(6 * (i / 16))}};
    const Factors f = factor(rotation(pose));
    EXPECT_TRUE(quarter(f.gamma) && quarter(f.alpha) && quarter(f.theta)) << i;
    EXPECT_EQ(difference(rotation(f), rotation(pose)), 0) << i;
  }
}

TEST(Factor, RecomposesAnyRotation) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> angle(-4, 4);
  for (int i = 0; i < 1000; ++i) {
    const Matrix3<double> R = rotation(Pose{{}, {angle(random), angle(random), angle(random)}});
    EXPECT_LT(difference(rotation(factor(R)), R), 2e-15);
  }
}

TEST(Factor, KeepsTiltsThatCosinesCannotSee) {
  const Matrix3<double> R = rotation(Pose{{}, {3e-9, 0, 0.5}});
  EXPECT_EQ(factor(R).alpha.c, 1);
  EXPECT_LT(difference(rotation(factor(R)), R), 1e-15);
}

TEST(Factor, TurnsAboutZNeedThetaOnly) {
  const Factors f = factor(rotation(Pose{{}, {0, 0, 0.3}}));
  EXPECT_EQ(f.gamma.c, 1);
  EXPECT_EQ(f.alpha.c, 1);
  EXPECT_EQ(f.theta.s, std::sin(0.3));
}

TEST(Tallied, CancellationBecomesZeroAndSmallNumbersStay) {
  EXPECT_EQ(clean(Tallied(0.1) + Tallied(0.2) - Tallied(0.3)), 0);
  EXPECT_EQ(clean(Tallied(1e-30) * Tallied(1.0)), 1e-30);
  EXPECT_EQ(clean_unit(1 - 2e-16), 1);
  EXPECT_EQ(clean_unit(1e-15), 1e-15);
}

TEST(MassMoments, MovingThereAndBackKeepsThem) {
  Inertial inertial;
  inertial.origin = {{0.1, -0.2, 0.3}, {0.4, 0.5, 0.6}};
  inertial.mass = 2;
  inertial.inertia = {0.3, 0.4, 0.5, 0.01, 0.02, -0.03};
  const MassMoments at_link = mass_moments(inertial);
  const Matrix3<double> R = rotation(Pose{{}, {1, 2, 3}});
  const Vector3<double> p{0.7, -0.8, 0.9};
  const MassMoments back = move(move(at_link, R, p), transpose(R), -1.0 * (transpose(R) * p));
  EXPECT_EQ(back.m, 2);
  EXPECT_NEAR(back.h.x, at_link.h.x, 1e-15);
  EXPECT_NEAR(back.Sigma.xx, at_link.Sigma.xx, 1e-14);
  EXPECT_NEAR(back.Sigma.yz, at_link.Sigma.yz, 1e-14);
}

TEST(Lower, BodiesAreTheMovingLinksAndWorldWeldsVanish) {
  Model model;
  model.name = "weld";
  model.root = 0;
  for (const char* name : {"base", "stand", "arm", "hand"}) {
    Link link;
    link.name = name;
    link.inertial = Inertial{{}, 1, {1, 1, 1, 0, 0, 0}};
    model.links.push_back(link);
  }
  const auto add = [&](const char* name, JointType type, int parent, int child) {
    Joint joint;
    joint.name = name;
    joint.type = type;
    joint.parent = parent;
    joint.child = child;
    joint.origin.xyz = {0, 0, 1};
    model.joints.push_back(joint);
  };
  add("weld1", JointType::kFixed, 0, 1);
  add("turn", JointType::kRevolute, 1, 2);
  add("weld2", JointType::kFixed, 2, 3);
  const DynamicTree tree = lower(model, {});
  ASSERT_EQ(tree.nb(), 1);
  EXPECT_EQ(tree.body[1].inertia.m, 2);
  EXPECT_EQ(tree.frame[1].body, 0);
  EXPECT_EQ(tree.frame[1].p.z, 1);
  EXPECT_EQ(tree.frame[3].body, 1);
  EXPECT_TRUE(tree.frame[2].moving);
  EXPECT_FALSE(tree.frame[3].moving);
}

TEST(Lower, PrintsATree) {
  Model model;
  model.name = "pendulum";
  model.root = 0;
  model.links.resize(2);
  model.links[0].name = "base";
  model.links[1].name = "bob";
  model.links[1].inertial = Inertial{{{0, 0, -0.5}, {}}, 2, {0.25, 0.25, 0.5, 0, 0, 0}};
  Joint joint;
  joint.name = "hinge";
  joint.type = JointType::kRevolute;
  joint.parent = 0;
  joint.child = 1;
  joint.origin.xyz = {0, 0, 3};
  model.joints.push_back(joint);
  EXPECT_EQ(print(lower(model, {})),
            "tree pendulum: 1 bodies, nq 1, nv 1, gravity(0 0 -9.81)\n"
            "body 1 'bob': revolute 'hinge' on 0, q 0 v 0 gamma(0 1) alpha(0 1) c(0 0 3) m(2) "
            "h(0 -1 0) Sigma(xx 0.25 yy 0.5 zz 0.25 xy 0 xz 0 yz 0)\n"
            "frame 'base': on 0\n"
            "frame 'bob': on 1 x(0 0 1) y(1 0 0) z(0 1 0) moving\n");
}

TEST(Lower, AlignedModelsNeedQuarterTurnsOnly) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    RandomModelOptions options;
    options.aligned = true;
    options.mimic = false;
    for (const BodyOf<double>& body : lower(random_model(seed, options), {}).body)
      EXPECT_TRUE(quarter(body.gamma) && quarter(body.alpha) && quarter(body.theta)) << seed;
  }
}

TEST(Lower, RegroupingEmptiesWhatItMoves) {
  for (unsigned seed = 0; seed < 50; ++seed)
    for (const BodyOf<double>& body : lower(random_model(seed, {}), {FrameChoice::kAxis, true}).body) {
      const MassMoments& I = body.inertia;
      if (body.motion == Motion::kRevolute) {
        EXPECT_TRUE(I.m == 0 && I.h.z == 0 && I.Sigma.zz == 0) << body.link;
      }
      if (body.motion == Motion::kPrismatic) {
        EXPECT_TRUE(I.Sigma.xx == 0 && I.Sigma.yy == 0 && I.Sigma.zz == 0 && I.Sigma.xy == 0);
      }
      if (body.motion == Motion::kPlanar) {
        EXPECT_EQ(I.Sigma.zz, 0);
      }
    }
}

TEST(Lower, DenavitFramesPutMainChildrenAlongX) {
  RandomModelOptions options;
  options.many_freedoms = false;
  options.mimic = false;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const DynamicTree tree = lower(random_model(seed, options), {FrameChoice::kDenavit, false});
    std::vector<int> size(tree.body.size(), 1), children(tree.body.size(), 0);
    for (int i = tree.nb(); i > 0; --i) {
      const auto parent = static_cast<size_t>(tree.body[static_cast<size_t>(i)].parent);
      size[parent] += size[static_cast<size_t>(i)];
      ++children[parent];
    }
    for (size_t i = 1; i < tree.body.size(); ++i) {
      const BodyOf<double>& body = tree.body[i];
      if (children[i] == 0 && body.motion == Motion::kRevolute) {
        EXPECT_EQ(body.inertia.h.y * body.inertia.h.x, 0) << seed << ' ' << i;
      }
      if (body.parent > 0 && children[static_cast<size_t>(body.parent)] == 1) {
        EXPECT_TRUE(quarter(body.gamma) || std::hypot(body.c.x, body.c.y) < 1e-9 ||
                    body.alpha.s < 0.1)
            << seed << ' ' << i;
      }
    }
  }
}

/// Elimination from the last row up on the dense pattern.
std::vector<std::vector<int>> dense_coupling(const DynamicTree& tree) {
  const auto n = static_cast<size_t>(tree.nv);
  std::vector<std::vector<bool>> M(n, std::vector<bool>(n));
  for (int i = 1; i <= tree.nb(); ++i)
    for (int k = i; k > 0; k = tree.body[static_cast<size_t>(k)].parent) {
      const BodyOf<double> &a = tree.body[static_cast<size_t>(i)], &b = tree.body[static_cast<size_t>(k)];
      for (int d = 0; d < freedoms(a.motion); ++d)
        for (int e = 0; e < freedoms(b.motion); ++e) {
          const auto r = static_cast<size_t>(a.v + d), c = static_cast<size_t>(b.v + e);
          M[r][c] = M[c][r] = true;
        }
    }
  std::vector<std::vector<int>> coupled(n);
  for (size_t k = n; k-- > 0;) {
    for (size_t i = k; i-- > 0;)
      if (M[i][k]) coupled[k].push_back(static_cast<int>(i));
    for (const int i : coupled[k])
      for (const int j : coupled[k]) M[static_cast<size_t>(i)][static_cast<size_t>(j)] = true;
  }
  return coupled;
}

TEST(Coupling, IsThePatternOfDenseElimination) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    RandomModelOptions options;
    options.joints = 15;
    const DynamicTree tree = lower(random_model(seed, options), {});
    EXPECT_EQ(tree.coupled, dense_coupling(tree)) << seed;
  }
}

TEST(Lower, LongChainsAndWideStarsTakeLinearTime) {
  for (const bool chain : {true, false}) {
    Model model;
    model.root = 0;
    model.links.resize(20001);
    for (int k = 1; k <= 20000; ++k) {
      Joint joint;
      joint.type = JointType::kRevolute;
      joint.parent = chain ? k - 1 : 0;
      joint.child = k;
      joint.origin = {{0.1, 0.2, 0.3}, {0.3, 0.2, 0.1}};
      model.joints.push_back(joint);
      model.links[static_cast<size_t>(k)].inertial = Inertial{{}, 1, {1, 1, 1, 0, 0, 0}};
    }
    const DynamicTree tree = lower(model, {FrameChoice::kDenavit, true});
    EXPECT_EQ(tree.nb(), 20000);
    EXPECT_TRUE(tree.coupled.empty());
  }
}

}  // namespace
}  // namespace arboc::test

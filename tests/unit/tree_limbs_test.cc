// find_limbs(): which subtrees count as alike, in printed form.
#include "tree/limbs.h"

#include <gtest/gtest.h>

namespace arboc::test {
namespace {

/// Adds a body of one joint; q and v follow one another.  Numbers are all different.
int add(DynamicTree& tree, int parent, const std::string& link, Motion motion = Motion::kRevolute) {
  BodyOf<double> body;
  const int index = static_cast<int>(tree.body.size());
  body.link = link;
  body.parent = parent;
  body.motion = motion;
  body.q = tree.nq;
  body.v = tree.nv;
  body.c = {0.1 * index, 0.2, -0.3 * index};
  body.inertia.m = index;
  tree.nq += freedoms(motion) + (has_quaternion(motion) ? 1 : 0);
  tree.nv += freedoms(motion);
  tree.body.push_back(body);
  return index;
}

DynamicTree world() {
  DynamicTree tree;
  tree.name = "t";
  tree.body.emplace_back();
  return tree;
}

/// A chain of joints; returns its last body.
int chain(DynamicTree& tree, int parent, const std::string& name,
          const std::vector<Motion>& kinds) {
  for (size_t k = 0; k < kinds.size(); ++k)
    parent = add(tree, parent, name + std::to_string(k), kinds[k]);
  return parent;
}

constexpr Motion kTurn = Motion::kRevolute, kSlide = Motion::kPrismatic;

std::string limbs(const DynamicTree& tree, int most = 4) {
  return print(tree, find_limbs(tree, most));
}

TEST(Limbs, LegsOfAQuadruped) {
  DynamicTree tree = world();
  const int trunk = add(tree, 0, "trunk", Motion::kFloating);
  for (const char* leg : {"a", "b", "c", "d"}) chain(tree, trunk, leg, {kTurn, kTurn});
  EXPECT_EQ(limbs(tree),
            "limbs t: 1 groups\n"
            "4 limbs of 2 bodies on 'trunk': 'a0' 'a1', 'b0' 'b1', 'c0' 'c1', 'd0' 'd1'\n");
}

TEST(Limbs, LegsAndArmsOfAHumanoid) {
  DynamicTree tree = world();
  const int pelvis = add(tree, 0, "pelvis", Motion::kFloating);
  chain(tree, pelvis, "left", {kTurn, kTurn});
  const int torso = add(tree, pelvis, "torso");
  chain(tree, torso, "hand", {kTurn});
  chain(tree, torso, "fist", {kTurn});
  chain(tree, pelvis, "right", {kTurn, kTurn});
  EXPECT_EQ(limbs(tree),
            "limbs t: 2 groups\n"
            "2 limbs of 2 bodies on 'pelvis': 'left0' 'left1', 'right0' 'right1'\n"
            "2 limbs of 1 bodies on 'torso': 'hand0', 'fist0'\n");
}

TEST(Limbs, TheOrderOfBranchesDoesNotMatter) {
  DynamicTree tree = world();
  const int a = add(tree, 0, "a");
  chain(tree, a, "as", {kSlide});
  chain(tree, a, "at", {kTurn, kTurn});
  const int b = add(tree, 0, "b");
  chain(tree, b, "bt", {kTurn, kTurn});
  chain(tree, b, "bs", {kSlide});
  EXPECT_EQ(limbs(tree),
            "limbs t: 1 groups\n"
            "2 limbs of 4 bodies on the world: 'a' 'at0' 'as0' 'at1', 'b' 'bt0' 'bs0' 'bt1'\n");
}

TEST(Limbs, OthersAreNotAlike) {
  DynamicTree tree = world();
  chain(tree, 0, "a", {kTurn, kTurn});
  chain(tree, 0, "b", {kTurn, kSlide});
  chain(tree, 0, "c", {kTurn, kTurn, kTurn});
  chain(tree, 0, "d", {Motion::kSpherical, kTurn});
  EXPECT_EQ(limbs(tree), "limbs t: 0 groups\n");
}

TEST(Limbs, OutermostOnly) {
  DynamicTree tree = world();
  for (const char* arm : {"l", "r"}) {
    const int hand = chain(tree, 0, arm, {kTurn});
    for (const char* finger : {"1", "2", "3"})
      chain(tree, hand, std::string(arm) + finger, {kTurn});
  }
  EXPECT_EQ(limbs(tree),
            "limbs t: 1 groups\n2 limbs of 4 bodies on the world: 'l0' 'l10' 'l20' 'l30', 'r0' "
            "'r10' 'r20' 'r30'\n");
}

TEST(Limbs, LargeGroupsAreDivided) {
  DynamicTree tree = world();
  for (const char* leg : {"a", "b", "c", "d", "e", "f", "g", "h", "i"})
    chain(tree, 0, leg, {kTurn});
  EXPECT_EQ(limbs(tree),
            "limbs t: 2 groups\n"
            "4 limbs of 1 bodies on the world: 'a0', 'b0', 'c0', 'd0'\n"
            "4 limbs of 1 bodies on the world: 'e0', 'f0', 'g0', 'h0'\n");
}

TEST(Limbs, MimicJointsStayInTheirLimb) {
  DynamicTree tree = world();
  for (const char* finger : {"a", "b", "c"}) {
    const int tip = chain(tree, 0, finger, {kTurn, kTurn});
    BodyOf<double>& body = tree.body[static_cast<size_t>(tip)];
    const BodyOf<double>& leader = tree.body[static_cast<size_t>(tip) - 1];
    body.q = leader.q;
    body.v = leader.v;
    body.multiplier = 2;
  }
  EXPECT_EQ(find_limbs(tree, 4).at(0).limbs(), 3);
  tree.body[6].multiplier = 3;  // the third finger's
  EXPECT_EQ(find_limbs(tree, 4).at(0).limbs(), 2);
  tree.body[4].v = tree.body[1].v;  // the second follows the first
  EXPECT_TRUE(find_limbs(tree, 4).empty());
}

}  // namespace
}  // namespace arboc::test

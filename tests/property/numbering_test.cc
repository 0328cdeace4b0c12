// Joints and links of the dynamic tree in their order: [Astronaut] section 2, Figures 4 and 5.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>

#include "frontend/dh.h"
#include "frontend/read_model.h"
#include "support/random.h"
#include "tree/numbering.h"

namespace arboc::test {
namespace {

/// One of low .. high.
int pick(Random& random, int low, int high) { return low + random.integer(high - low + 1); }

struct Node {
  int parent;        // -1: the base
  std::string axes;  // of the joint
};

/// A model of these joints, each link 1 m from its parent's.
Model model_of(const std::vector<Node>& nodes) {
  std::string text = "name = \"t\"\nunits = { length = \"m\", angle = \"rad\" }\n[joints]\n";
  for (size_t k = 0; k < nodes.size(); ++k)
    text += fmt::format("j{} = {{ axes = \"{}\" }}\n", k, nodes[k].axes);
  for (size_t k = 0; k < nodes.size(); ++k)
    text += fmt::format(
        "[[frames]]\nname = \"l{0}\"\njoint = \"j{0}\"\nparent = \"{1}\"\nxyz = [0, 0, 1]\nmass = "
        "1\ncg = [0, 0, 0.5]\ninertia = [1, 1, 1]\n",
        k, nodes[k].parent < 0 ? "base" : fmt::format("l{}", nodes[k].parent));
  Diagnostics diagnostics;
  return configure(parse_dh(text, "t.dh.toml", "", diagnostics), {}, diagnostics);
}

/// A link's root joint is before its branch joints, all of a left branch before a right one.
void expect_preorder(const std::vector<NumberedLink>& links) {
  size_t next = 0;
  const std::function<void(int)> visit = [&](int i) {
    EXPECT_EQ(static_cast<size_t>(i), next++);
    int last = i;
    for (const int b : links[static_cast<size_t>(i)].branches) {
      EXPECT_GT(b, last);
      EXPECT_EQ(links[static_cast<size_t>(b)].parent, i);
      last = b;
      visit(b);
    }
  };
  for (size_t i = 0; i < links.size(); ++i)
    if (links[i].parent < 0) visit(static_cast<int>(i));
  EXPECT_EQ(next, links.size());
}

/// Links as text, "0(1 2(3))"; dummies with a star.
std::string shape(const std::vector<NumberedLink>& links) {
  const std::function<std::string(int)> text = [&](int i) {
    const NumberedLink& link = links[static_cast<size_t>(i)];
    std::string out = std::to_string(i) + (link.dummy ? "*" : "");
    if (link.branches.empty()) return out;
    out += "(";
    for (const int b : link.branches) out += (out.back() == '(' ? "" : " ") + text(b);
    return out + ")";
  };
  return text(0);
}

// Figure 4: J0 on the base; eight joints, four of which have two axes, make the twelve of Figure 5.
TEST(Numbering, OfTheFiguresOfThePaper) {
  const std::vector<Node> articulated = {{-1, "Z"}, {0, "X"}, {0, "Z"}, {2, "Y"},
                                         {2, "Z"},  {4, "X"}, {4, "Y"}, {0, "Z"}};
  EXPECT_EQ(shape(number_links(model_of(articulated))), "0(1 2(3 4(5 6)) 7)");
  std::vector<Node> two = articulated;
  two[1].axes = "ZY";
  two[3].axes = "XY";
  two[5].axes = "YX";
  two[7].axes = "XZ";
  const auto links = number_links(model_of(two));
  ASSERT_EQ(links.size(), 12u);
  EXPECT_EQ(shape(links), "0(1*(2) 3(4*(5) 6(7*(8) 9)) 10*(11))");
  EXPECT_EQ(links[7].joint, "j5.y");
  EXPECT_EQ(links[8].link, "l5");
}

std::vector<NumberedLink> links_of(const std::string& name, const std::string& hang_from = "") {
  Diagnostics diagnostics;
  ModelOptions options;
  options.hang_from = hang_from;
  return number_links(configure(
      read_model(ARBOC_SOURCE_DIR "/models/" + name + "/" + name + ".dh.toml", diagnostics),
      options, diagnostics));
}

// Figure 11: six joints beside the fictitious one; L1, L2, L4, L5 are dummies.
TEST(Numbering, OfTheAstronautWhoTurns) {
  const auto links = links_of("astronaut_turn");
  EXPECT_EQ(shape(links), "0(1*(2*(3)) 4*(5*(6)))");
  EXPECT_EQ(links[0].type, "floating");
}

// Figure 12: 13 joints and 13 links, a dummy at the left wrist; held by either hand.
TEST(Numbering, OfTheAstronautOnTheLadder) {
  EXPECT_EQ(shape(links_of("astronaut_ladder")), "0*(1(2(3*(4(5*(6(7(8*(9*)))) 10*(11(12)))))))");
  const auto left = links_of("astronaut_ladder", "l_grip");
  EXPECT_EQ(left.size(), 13u);
  EXPECT_EQ(left[0].joint, "l_wrist.z");
  expect_preorder(left);
}

TEST(Numbering, OfRandomTreesIsAPreorder) {
  const char* axes[] = {"X", "Y", "Z", "XY", "ZY", "YX", "XYZ", "ZYX", "YZX"};
  for (const std::uint64_t seed : seeds(1000)) {
    Random random(seed);
    std::vector<Node> nodes;
    size_t freedoms = 0;
    const int n = pick(random, 1, 12);
    for (int k = 0; k < n; ++k) {
      nodes.push_back({k == 0 ? -1 : pick(random, 0, k - 1), axes[pick(random, 0, 8)]});
      freedoms += nodes.back().axes.size();
    }
    const auto links = number_links(model_of(nodes));
    ASSERT_EQ(links.size(), freedoms);  // joints as many as freedoms, links as many as joints
    size_t dummies = 0;
    for (const NumberedLink& link : links) dummies += link.dummy ? 1 : 0;
    EXPECT_EQ(dummies, freedoms - nodes.size());
    expect_preorder(links);
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Numbering, Drawing) {
  const auto links = number_links(model_of({{-1, "XY"}, {0, "Z"}, {0, "Z"}}));
  const std::string svg = draw_svg("a < b", links);
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_NE(svg.find("stroke-dasharray"), std::string::npos);
  for (const char* text : {">J0<", ">J3<", ">L0 ", ">L3 ", ">null link<"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

}  // namespace
}  // namespace arboc::test

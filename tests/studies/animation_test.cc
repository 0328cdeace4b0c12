// What animations become: segments, glTF, a page with a player.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "common/gltf.h"
#include "common/page.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

using study::Animation;
using study::Rows;
using study::Segment;

/// A bar of 0.5 m that turns about z, a quarter a second, and is pushed at its end; a floor.
Animation turning() {
  Animation a;
  a.name = "turning <bar>";
  a.bodies = {"base", "bar"};
  a.placements = Rows(5, 24);
  Rows push(5, 3);
  for (int k = 0; k < 5; ++k) {
    const double angle = 1.5707963267948966 * k, c = std::cos(angle), s = std::sin(angle);
    a.times.push_back(k);
    a.placements.row(k) << 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0.1, c, -s, 0, s, c, 0, 0, 0, 1, 0, 0,
        1;
    push.row(k) << 0, 0, 10.0 * k;
  }
  a.sticks = {{{1, {0, 0, 0}}, {1, {0.5, 0, 0}}, 0.04}};
  a.add_limb({"base", "bar"});
  a.forces = {{"push", {1, {0.5, 0, 0}}, push}};
  a.fixtures = {{{-1, 0, 0}, {1, 0, 0}}};
  a.metre_per_newton = 0.01;
  return a;
}

TEST(Animation, PointsAreWhereTheirBodiesAre) {
  const auto all = study::segments(turning());
  ASSERT_EQ(all.size(), 4U);
  Eigen::RowVectorXd expected(6);
  expected << 0, 0, 1, 0, 0.5, 1;
  EXPECT_LT((all[0].ends.row(1) - expected).norm(), 1e-15);
  expected << 0, 0, 0.1, 0, 0, 1;
  EXPECT_LT((all[1].ends.row(3) - expected).norm(), 1e-15);
  expected << -0.5, 0, 1, -0.5, 0, 1.2;
  EXPECT_LT((all[2].ends.row(2) - expected).norm(), 1e-15);
  EXPECT_EQ(all[2].kind, Segment::Kind::kForce);
  EXPECT_EQ(all[3].ends.rows(), 1);
}

TEST(Animation, WhatDoesNotFitIsRefused) {
  Animation a = turning();
  a.times[3] = a.times[2];
  EXPECT_THROW(study::segments(a), std::invalid_argument);
  a = turning();
  a.bodies.push_back("leg");
  EXPECT_THROW(study::segments(a), std::invalid_argument);
  a = turning();
  a.forces[0].newtons = Rows::Zero(4, 3);
  EXPECT_THROW(study::segments(a), std::invalid_argument);
  EXPECT_THROW(turning().add_limb({"base", "nothing"}), std::invalid_argument);
  a = turning();
  a.sticks[0].to.body = 2;
  EXPECT_THROW(study::segments(a), std::invalid_argument);
}

/// The two chunks of a .glb file.
struct Glb {
  nlohmann::json json;
  std::string binary;

  explicit Glb(const std::string& file) {
    const auto word = [&](std::size_t at) {
      std::uint32_t x = 0;
      std::memcpy(&x, file.data() + at, 4);
      return x;
    };
    EXPECT_EQ(file.substr(0, 4), "glTF");
    EXPECT_EQ(word(4), 2U);
    EXPECT_EQ(word(8), file.size());
    EXPECT_EQ(file.substr(16, 4), "JSON");
    json = nlohmann::json::parse(file.substr(20, word(12)));
    const std::size_t second = 20 + word(12);
    EXPECT_EQ(second % 4, 0U);
    EXPECT_EQ(file.substr(second + 4, 3), "BIN");
    binary = file.substr(second + 8);
    EXPECT_EQ(binary.size(), word(second));
  }
  std::vector<float> floats(int accessor) const {
    const auto& a = json["accessors"][accessor];
    const auto& view = json["bufferViews"][a["bufferView"].get<int>()];
    std::vector<float> out(view["byteLength"].get<std::size_t>() / 4);
    std::memcpy(out.data(), binary.data() + view["byteOffset"].get<std::size_t>(), 4 * out.size());
    return out;
  }
  int node(const std::string& name) const {
    for (std::size_t k = 0; k < json["nodes"].size(); ++k)
      if (json["nodes"][k]["name"] == name) return static_cast<int>(k);
    return -1;
  }
  std::vector<float> channel(int of, const std::string& path) const {
    const auto& animation = json["animations"][0];
    for (const auto& c : animation["channels"])
      if (c["target"]["node"] == of && c["target"]["path"] == path)
        return floats(animation["samplers"][c["sampler"].get<int>()]["output"].get<int>());
    return {};
  }
};

TEST(Animation, GltfHasBodiesAndTheirMotion) {
  const Glb file(study::glb(turning()));
  EXPECT_EQ(file.json["buffers"][0]["byteLength"], file.binary.size());
  for (const auto& view : file.json["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0U);
    EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(),
              file.binary.size());
  }
  const int bar = file.node("bar"), stick = file.node("bar-bar"), push = file.node("push");
  ASSERT_GE(bar, 0);
  EXPECT_TRUE(file.channel(bar, "translation").empty());  // it only turns
  const auto turn = file.channel(bar, "rotation");
  ASSERT_EQ(turn.size(), 20U);
  EXPECT_NEAR(turn[4 + 2], std::sin(0.7853981633974483), 1e-7);
  EXPECT_NEAR(turn[16 + 2], 0, 1e-7);  // a whole turn, without a jump on the way: w has come to -1
  EXPECT_NEAR(turn[16 + 3], -1, 1e-7);
  ASSERT_GE(stick, 0);
  EXPECT_NEAR(file.json["nodes"][stick]["scale"][2].get<double>(), 0.5, 1e-12);
  const auto length = file.channel(push, "scale");
  ASSERT_EQ(length.size(), 15U);
  EXPECT_NEAR(length[14], 0.4, 1e-6);  // 40 N
  const auto& root = file.json["nodes"][0];
  EXPECT_EQ(root["children"].size() + 1, file.json["nodes"].size());
  // z of the world is y of glTF: a quarter turn about -x.
  EXPECT_NEAR(root["rotation"][0].get<double>(), -std::sqrt(0.5), 1e-12);
}

TEST(Animation, GltfOfAPictureHasNoAnimation) {
  Animation a = turning();
  a.times.resize(1);
  a.placements.conservativeResize(1, Eigen::NoChange);
  a.forces.clear();
  EXPECT_FALSE(Glb(study::glb(a)).json.contains("animations"));
  a.times.clear();
  a.placements.resize(0, 24);
  EXPECT_THROW(study::glb(a), std::invalid_argument);
}

TEST(Animation, PageHasAllOfIt) {
  const Animation a = turning();
  study::Page page{
      "turning <bar>",
      {"a < b"},
      {{"numbers", {"what", "how much"}, {{"x", "1"}}}},
      {{"angle", "t (s)", "rad", {{"q", Eigen::Vector2d(0, 4), Eigen::Vector2d(0, 6)}}}},
      &a};
  const std::string text = study::html(page);
  for (const char* part :
       {"<h1>turning &lt;bar&gt;</h1>", "<p>a &lt; b</p>", "<canvas", "<td>x</td>",
        "class=\"curve\"", "class=\"now\"", "requestAnimationFrame"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(text.find("http://", text.find("<canvas")), text.find("http://www.w3.org"));
  page.animation = nullptr;
  EXPECT_EQ(study::html(page).find("<canvas"), std::string::npos);
}

/// Where node is: the script reads, and finds points between frames.
TEST(Animation, PlayerInterpolates) {
  if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no node";
  const Outcome run =
      run_program({"/usr/bin/env", "node", "-e",
                   std::string(study::player_script()) +
                       "const times = [0, 1, 3], s = {ends: [0,0,0,0,0,0, 10000,0,0,0,20000,0, "
                       "10000,0,40000,0,20000,0]};\n"
                       "const at = t => ends_at(s, ...between(times, t)).join(' ');\n"
                       "console.log([-1, 0.5, 1, 2, 3, 9].map(at).join('|'));"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "0 0 0 0 0 0|0.5 0 0 0 1 0|1 0 0 0 2 0|1 0 2 0 2 0|1 0 4 0 2 0|1 0 4 0 2 0\n");
}

}  // namespace
}  // namespace arboc::test

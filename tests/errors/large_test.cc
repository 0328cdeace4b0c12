// Sizes around the limits: whatever is accepted is read in linear time and without recursion.
#include <gtest/gtest.h>

#include <ctime>

#include "frontend/builder.h"
#include "frontend/xml.h"
#include "support/urdf_text.h"

namespace arboc::test {
namespace {

constexpr double kMostSeconds = 2;  // of processor time: machines are shared

Reading try_quickly(const std::string& text) {
  const std::clock_t begin = std::clock();
  Reading reading = try_text(text);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_LT(seconds, kMostSeconds);
  return reading;
}

TEST(Large, LongestChain) {
  const Reading reading = try_quickly(chain_text(static_cast<int>(kMaxLinks) - 1));
  ASSERT_TRUE(reading.model) << reading.what;
  EXPECT_EQ(reading.model->links.size(), kMaxLinks);
}

TEST(Large, ChainBeyondTheLimit) {
  EXPECT_EQ(try_quickly(chain_text(static_cast<int>(kMaxLinks))).what,
            "robot.urdf:40001:1: error: link 'l20000': the robot has too many links "
            "(the limit is 20000)");
}

TEST(Large, Star) {
  const Reading reading = try_quickly(frames_text(static_cast<int>(kMaxLinks) - 1));
  ASSERT_TRUE(reading.model) << reading.what;
}

TEST(Large, NestedDeep) {
  const std::string text = "<robot name=\"a\">" + repeated("<visual>", 100000) +
                           repeated("</visual>", 100000) + "</robot>";
  const Reading reading = try_quickly(text);
  ASSERT_FALSE(reading.model);
  EXPECT_EQ(reading.what,
            "robot.urdf:1:1033: error: elements are nested too deep: the limit is 128");
}

TEST(Large, DeepestNesting) {
  const auto nested = [](int depth) {
    return "<robot name=\"a\"><link name=\"l\"/>" + repeated("<gazebo>", depth - 1) +
           repeated("</gazebo>", depth - 1) + "</robot>";
  };
  EXPECT_TRUE(try_quickly(nested(kMaxDepth)).model);
  EXPECT_FALSE(try_quickly(nested(kMaxDepth + 1)).model);
}

TEST(Large, ManyErrors) {
  const std::string text = "<robot name=\"a\">" + repeated("<link/>", 1000000) + "</robot>";
  const Reading reading = try_quickly(text);
  EXPECT_EQ(reading.diagnostics.error_count(), 20);
  EXPECT_EQ(reading.diagnostics.all().back().message, "980 more errors not shown");
}

TEST(Large, ManyUnknownNames) {
  std::string text = "<robot name=\"a\">\n" + link_text("base");
  for (int k = 0; k < 10000; ++k)
    text += "<joint name=\"j" + std::to_string(k) + "\" type=\"fixed\"><parent link=\"" +
            std::string(500, 'x') + "\"/><child link=\"base\"/></joint>\n";
  EXPECT_EQ(try_quickly(text + "</robot>").diagnostics.error_count(), 20);
}

TEST(Large, ManyAttributes) {
  const auto unknown = [](size_t count) {
    std::string text = "<robot name=\"a\"><link name=\"l\"";
    for (size_t k = 1; k < count; ++k) text += " a" + std::to_string(k) + "=\"1\"";
    return text + "/></robot>";
  };
  EXPECT_TRUE(try_quickly(unknown(kMaxAttributes)).model);
  EXPECT_EQ(try_quickly(unknown(kMaxAttributes + 1)).what,
            "robot.urdf:1:17: error: an element has too many attributes (the limit is 100000)");
  EXPECT_FALSE(try_quickly(unknown(4000000)).model);
}

TEST(Large, ManyItems) {
  const auto skipped = [](size_t count) {  // beside robot, link, gazebo and two names
    return "<robot name=\"a\"><link name=\"l\"/><gazebo>" +
           repeated("<x/>", static_cast<int>(count)) + "</gazebo></robot>";
  };
  EXPECT_TRUE(try_quickly(skipped(kMaxItems - 5)).model);
  EXPECT_EQ(try_quickly(skipped(kMaxItems - 4)).what,
            "robot.urdf:1:8000021: error: the document has too many elements and attributes (the "
            "limit is 2000000)");
}

TEST(Large, ManyNumbers) {
  EXPECT_EQ(try_quickly("<robot name='r'><link name='a'><visual><origin xyz='" +
                        repeated("1 ", 20000000) + "'/></visual></link></robot>")
                .messages(),
            "robot.urdf:1:48: warning: link 'a': <visual>: <origin>: xyz: more than 100 numbers "
            "where 3 are needed\nrobot.urdf: note: ignored: 1 <visual>\n");
}

TEST(Large, MimicChain) {
  std::string text = "<robot name=\"a\">\n" + link_text("l0");
  for (int k = 1; k < 10000; ++k) {
    const std::string number = std::to_string(k), before = std::to_string(k - 1);
    text += link_text("l" + number) + "<joint name=\"j" + number +
            "\" type=\"continuous\"><parent link=\"l" + before + "\"/><child link=\"l" + number +
            "\"/><axis xyz=\"1 0 0\"/>" +
            (k > 1 ? "<mimic joint=\"j" + before + "\"/>" : std::string()) + "</joint>\n";
  }
  EXPECT_TRUE(try_quickly(text + "</robot>").model);
}

TEST(Large, LoopOfAllLinks) {
  std::string text = "<robot name=\"a\">\n";
  const int count = static_cast<int>(kMaxLinks);
  for (int k = 0; k < count; ++k) {
    const std::string number = std::to_string(k);
    text += "<link name=\"l" + number + "\"/><joint name=\"j" + number +
            "\" type=\"fixed\"><parent link=\"l" + number + "\"/><child link=\"l" +
            std::to_string((k + 1) % count) + "\"/></joint>\n";
  }
  EXPECT_EQ(try_quickly(text + "</robot>").diagnostics.error_count(), 1);
}

}  // namespace
}  // namespace arboc::test

// Checks of docs/conventions.md in words: placements, joints, orders of coordinates, files.
#include <gtest/gtest.h>

#include <cmath>

#include "differential/conventions_checks.h"
#include "differential/conventions_robot.h"
#include "support/page.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

using Eigen::Vector3d;

constexpr double kRounding = 1e-14;  // of numbers about 1
constexpr double kQuarter = 1.5707963267948966;

void expect_vector(const Vector3d& actual, const Vector3d& expected, double tolerance = kRounding) {
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), tolerance) << actual.transpose();
}

void rpy_about_x() {
  const OneJoint robot("revolute", R"(<origin rpy="1.5707963267948966 0 0"/><axis xyz="0 0 1"/>)");
  expect_vector(robot.pose({0}).R.col(1), Vector3d::UnitZ());
}
void rpy_about_z() {
  const OneJoint robot("revolute", R"(<origin rpy="0 0 1.5707963267948966"/><axis xyz="0 0 1"/>)");
  expect_vector(robot.pose({0}).R.col(0), Vector3d::UnitY());
}
void turn_about_y() {
  const OneJoint robot("revolute", R"(<axis xyz="0 1 0"/>)");
  expect_vector(robot.pose({0.1}).R.col(0), {std::cos(0.1), 0, -std::sin(0.1)});
}
void turn_about_minus_y() {
  const OneJoint robot("revolute", R"(<axis xyz="0 -1 0"/>)");
  expect_vector(robot.pose({0.1}).R.col(0), {std::cos(0.1), 0, std::sin(0.1)});
}
void slide_along_minus_y() {
  const OneJoint robot("prismatic", R"(<origin xyz="1 2 3"/><axis xyz="0 -1 0"/>)");
  expect_vector(robot.pose({0.2}).p, {1, 1.8, 3});
}
void slide_along_turned_z() {
  const OneJoint robot("prismatic",
                       R"(<origin xyz="1 2 3" rpy="1.5707963267948966 0 0"/><axis xyz="0 0 1"/>)");
  expect_vector(robot.pose({0.2}).p, {1, 1.8, 3});
}

void planar_normal_to_z() {
  const OneJoint robot("planar", R"(<axis xyz="0 0 1"/>)");
  const std::vector<double> q{1, 2, kQuarter};
  expect_vector(robot.pose(q).p, {1, 2, 0});
  const auto velocity =
      eval(robot.path(), "--function frame_velocity --axes aligned", {{"q", q}, {"v", {1, 0, 0}}});
  expect_vector({velocity.at(0), velocity.at(1), velocity.at(2)}, {0, 1, 0});
}
void planar_normal_to_x() {
  const OneJoint robot("planar", R"(<axis xyz="1 0 0"/>)");
  expect_vector(robot.pose({1, 2, 0}).p, {0, 1, 2});
}

Vector3d linear(const std::vector<double>& twist) {
  return {twist.at(0), twist.at(1), twist.at(2)};
}

void floating_velocity() {
  const double h = std::sqrt(0.5);
  const auto velocity =
      eval(own("double_pendulum"), kCube + "--function frame_velocity --axes aligned",
           {{"q", {0, 0, 0, 0, 0, h, h}}, {"v", {1, 0, 0, 0, 0, 0}}});
  expect_vector(linear(velocity), {0, 1, 0});
}

void circle() {
  const Inputs motion{
      {"q", {0, 0, 0, 0, 0, 0, 1}}, {"v", {1, 0, 0, 0, 0, 1}}, {"a", {0, 0, 0, 0, 0, 0}}};
  const Vector3d v =
      linear(eval(own("double_pendulum"), kCube + "--function frame_velocity --axes aligned",
                  {{"q", motion.at("q")}, {"v", motion.at("v")}}));
  const Vector3d a = linear(
      eval(own("double_pendulum"), kCube + "--function frame_acceleration --axes aligned", motion));
  EXPECT_NEAR(v.dot(a), 0, kRounding);
  EXPECT_NEAR(v.squaredNorm() / a.norm(), 1, kRounding);
}

/// Legs of the quadruped as `inspect` lists them.
std::string legs(const std::string& order) {
  const std::string text = run_arboc({"inspect", own("quadruped"), "--joint-order", order}).out;
  std::map<size_t, std::string> found;
  for (const char* leg : {"left_front", "right_front", "left_hind", "right_hind"})
    found[text.find(leg)] = leg;
  std::string list;
  for (const auto& [place, leg] : found) list += leg + " ";
  return list;
}
void order_of_the_file() {
  EXPECT_EQ(legs("file"), "left_front right_front left_hind right_hind ");
}
void order_of_names() {
  EXPECT_EQ(legs("alphabetical"), "left_front left_hind right_front right_hind ");
}

void locked_elbow() {
  const auto locked =
      eval(own("double_pendulum"), "--lock elbow=1.5707963267948966 --function crba");
  const auto whole = eval(own("double_pendulum"), "--function crba", {{"q", {0.3, kQuarter}}});
  ASSERT_EQ(locked.size(), 1u);
  EXPECT_NEAR(locked[0], whole.at(0), kRounding);
}

void dense_by_rows() {
  const auto M = eval(own("double_pendulum"), "--function crba", {{"q", {0, 0.4}}});
  ASSERT_EQ(M.size(), 4u);
  EXPECT_EQ(M[1], M[2]);
  EXPECT_GT(M[0], M[3]);
}
void sparse_by_columns() {
  const TempDir folder;
  ASSERT_EQ(
      run_arboc({"compile", own("double_pendulum"), "-o", folder.path(), "--functions", "crba"})
          .status,
      0);
  std::string text;
  for (const auto& file : std::filesystem::recursive_directory_iterator(folder.path()))
    if (file.path().extension() == ".hpp") text += read_text(file.path());
  const auto expect = [&](const std::string& what) {
    EXPECT_NE(single_spaced(text).find(what), std::string::npos) << what;
  };
  expect("crba_M_nnz = 3");
  expect("crba_M_row[3] = { 0, 0, 1");
  expect("crba_M_col[3] = { 0, 1, 1");
}

void snapped() {
  const OneJoint robot("revolute", R"(<origin rpy="1.57079632679 0 0"/><axis xyz="0 0 1"/>)");
  EXPECT_EQ(robot.pose({0}).R(1, 1), 0);
}
void not_snapped() {
  const OneJoint robot("revolute", R"(<origin rpy="1.5708 0 0"/><axis xyz="0 0 1"/>)");
  EXPECT_NEAR(robot.pose({0}).R(1, 1), std::cos(1.5708), 1e-16);
}

}  // namespace

std::vector<WordCheck> joint_checks() {
  return {
      {"RpyAboutX",
       R"(rpy="1.5707963267948966 0 0" takes the child's y axis to the parent's z axis)",
       rpy_about_x},
      {"RpyAboutZ",
       R"(rpy="0 0 1.5707963267948966" takes the child's x axis to the parent's y axis)",
       rpy_about_z},
      {"TurnAboutY", "axis 0 1 0, q = 0.1: x of the child becomes (0.995, 0, −0.0998)",
       turn_about_y},
      {"TurnAboutMinusY", "axis 0 −1 0, q = 0.1: x of the child becomes (0.995, 0, 0.0998)",
       turn_about_minus_y},
      {"SlideAlongMinusY", "axis 0 −1 0, rpy 0, q = 0.2: the child moves to xyz + (0, −0.2, 0)",
       slide_along_minus_y},
      {"SlideAlongTurnedZ",
       R"(axis 0 0 1, rpy "π/2 0 0", q = 0.2: the child moves to xyz + (0, −0.2, 0))",
       slide_along_turned_z},
      {"PlanarNormalToZ",
       "axis 0 0 1, q = (1, 2, π/2), v = (1, 0, 0): the body is at (1, 2, 0) and moves along +y",
       planar_normal_to_z},
      {"PlanarNormalToX", "axis 1 0 0, q = (1, 2, 0): the body is at (0, 1, 2)",
       planar_normal_to_x},
      {"FloatingVelocity",
       "q = (0, 0, 0, 0, 0, 0.7071, 0.7071), v = (1, 0, 0, 0, 0, 0): it moves along +y of the "
       "world",
       floating_velocity},
      {"Circle", "v = (1, 0, 0, 0, 0, 1), a = 0: the origin runs in a circle of radius 1", circle},
      {"OrderOfTheFile", "models/quadruped, file: left_front, right_front, left_hind, right_hind",
       order_of_the_file},
      {"OrderOfNames",
       "models/quadruped, alphabetical: left_front, left_hind, right_front, right_hind",
       order_of_names},
      {"LockedElbow",
       "--lock elbow=1.5707963267948966: M is the entry 11 of the whole pendulum at q_2 = π/2",
       locked_elbow},
      {"DenseByRows", "eval, M of two joints: M11, M12, M21, M22", dense_by_rows},
      {"SparseByColumns", "raw, M of two joints: M11, M12, M22", sparse_by_columns},
      {"Snapped", R"(rpy="1.57079632679 0 0" is taken as 90°, exactly)", snapped},
      {"NotSnapped", R"(rpy="1.5708 0 0" stays)", not_snapped},
  };
}

}  // namespace arboc::test

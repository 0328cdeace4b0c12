// Hand over hand along a ladder: hands on bars, the two levels of planning, trees at either hand,
// closed chains.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "frontend/read_model.h"
#include "ladder/report.h"
#include "reference/reference.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

namespace la = ladder;
using la::Joints;

constexpr double kDegree = 3.14159265358979323846 / 180;
const std::string kTasks = ARBOC_SOURCE_DIR "/apps/ladder/tasks/";

la::Task task(const std::string& name) { return la::read_task(kTasks + name + ".toml"); }

void expect_schedule(const la::Task& t, const la::Result& r) {
  ASSERT_EQ(r.schedule.size(), static_cast<std::size_t>(t.bars) + 1);
  std::array<int, 2> bars = {0, 0};
  for (std::size_t k = 0; k < r.schedule.size(); ++k) {
    const la::Contact& c = r.schedule[k];
    if (k > 0) {
      EXPECT_EQ(c.begin, r.schedule[k - 1].end);  // at every instant exactly one hand holds
      EXPECT_NE(c.held, r.schedule[k - 1].held);
    }
    EXPECT_LT(c.begin, c.end);
    EXPECT_EQ(c.bar, bars[c.held]);
    EXPECT_EQ(c.from, bars[la::other(c.held)]);
    const bool outer = k == 0 || k + 1 == r.schedule.size();
    EXPECT_EQ(c.to - c.from, outer ? 1 : 2);
    bars[la::other(c.held)] = c.to;
  }
  EXPECT_EQ(bars[0], t.bars);
  EXPECT_EQ(bars[1], t.bars);
}

void expect_traverse(const la::Task& t, const la::Result& r) {
  expect_schedule(t, r);
  EXPECT_LT(r.hand_error, 1e-9) << t.name;  // asked for are 1e-6
  EXPECT_LT(r.torso_mismatch, 1e-9) << t.name;
  EXPECT_LT(r.reroot_error, 1e-10) << t.name;
  EXPECT_LE(r.limit_excess, 0) << t.name;
  EXPECT_LE(r.joint_speed, t.joint_speed) << t.name;
  EXPECT_GT(r.clearance, t.bars > 1 ? 0.9 * t.clearance : -1) << t.name;
  EXPECT_LT(r.power_balance, 1e-9) << t.name;
}

TEST(Ladder, Traverse) {
  const la::Task t = task("traverse");
  const la::Result r = la::traverse(t);
  expect_traverse(t, r);
  EXPECT_LT(r.torso_mismatch_inside, 0.05);
  EXPECT_EQ(r.stretch, 1);
}

TEST(Ladder, AtRestAfterEachPeriod) {
  const la::Task t = task("traverse_stops");
  expect_traverse(t, la::traverse(t));
}

TEST(Ladder, AnyNumberOfBarsAndEitherHandFirst) {
  for (const int bars : {1, 2, 5, 30})
    for (const la::Hand first : {la::kRight, la::kLeft}) {
      la::Task t = task("traverse");
      t.bars = bars;
      t.first = first;
      t.duration = 1.4 * (bars + 1);
      expect_traverse(t, la::traverse(t));
    }
}

/// Left and right are mirror images, but for the wrists, whose axes come in the same order from
/// right to left: y at the right bar, z at the left one.
TEST(Ladder, OtherHandFirstIsTheMirrorImage) {
  la::Task t = task("traverse");
  const la::Result one = la::traverse(t);
  t.first = la::kRight;
  const la::Result two = la::traverse(t);
  const int right = la::joint("r_elbow"), left = la::joint("l_elbow");
  EXPECT_LT((one.effort.torques.col(right) + two.effort.torques.col(left)).cwiseAbs().maxCoeff(),
            1e-6);
  EXPECT_NEAR(one.energy.at("effort"), two.energy.at("effort"), 0.05 * one.energy.at("effort"));
}

TEST(Ladder, TooFastAJointStretchesTheTime) {
  la::Task t = task("traverse");
  t.joint_speed = 60 * kDegree;
  const la::Result r = la::traverse(t);
  EXPECT_GT(r.stretch, 1);
  EXPECT_LE(r.joint_speed, t.joint_speed * (1 + 1e-9));
  EXPECT_LT(r.torso_mismatch, 1e-9);
  t = task("traverse");
  t.torso_speed = 0.2;  // 2.7 m in 13 s
  EXPECT_THROW(la::traverse(t), NoSuchMotion);
}

TEST(Ladder, WhatCannotBeReachedIsSaid) {
  la::Task t = task("traverse");
  t.torso.x = -0.75;
  try {
    la::traverse(t);
    FAIL();
  } catch (const la::NoPosture& e) {
    EXPECT_NE(std::string(e.what()).find("an arm reaches"), std::string::npos) << e.what();
  }
  t = task("traverse");
  t.elbows = {-1, 1};
  try {
    la::traverse(t);
    FAIL();
  } catch (const la::NoPosture& e) {
    EXPECT_NE(std::string(e.what()).find("r_elbow would be at"), std::string::npos) << e.what();
  }
}

/// Both branches of each elbow lead the hands to their bars; only one is within limits.
TEST(Ladder, BranchesOfInverseKinematics) {
  const la::Torso torso{-0.45, -0.05, 0.2};
  const la::Vector3 hand(0, la::lengths().shoulders, 0.3);
  const Joints q = la::inverse(torso, hand, {1, 1}, {0, -0.3, 0.5});
  EXPECT_LT(la::inverse_error(q, torso, hand), 1e-12);
  EXPECT_GT(q[la::joint("r_elbow")], 0);
  EXPECT_LT(q[la::joint("l_elbow")], 0);
  EXPECT_EQ(q[la::joint("knee")], 0.5);
  for (const std::array<int, 2> branch : {std::array<int, 2>{-1, 1}, {1, -1}, {-1, -1}})
    EXPECT_THROW(la::inverse(torso, hand, branch, {0, 0, 0}), la::NoPosture);
  // A hand beside the plane of its shoulder cannot be had with the torso upright.
  EXPECT_THROW(la::inverse(torso, hand + la::Vector3(0, 0.2, 0), {1, 1}, {0, 0, 0}), la::NoPosture);
}

/// The engine that reads the model's file, hung from either hand: the same torques.
TEST(Ladder, ReferenceAgrees) {
  const la::Plan plan = la::plan(task("traverse"));
  for (const char* from : {"", "l_grip"}) {
    Diagnostics diagnostics;
    ModelOptions options;
    options.hang_from = from;
    const Model model =
        configure(read_model(ARBOC_SOURCE_DIR "/models/astronaut_ladder/astronaut_ladder.dh.toml",
                             diagnostics),
                  options, diagnostics);
    const Reference reference(model, {});
    const la::Hand held = *from ? la::kLeft : la::kRight;
    const la::Tree& tree = la::tree(held);
    la::Vector tau;
    int checked = 0;
    for (const la::Period& p : plan.periods) {
      if (p.held != held) continue;
      for (const double s : {0.1, 0.5, 0.8}) {
        const la::State state = p.at(p.begin + s * p.duration());
        tree.rnea(tree.own(state.q), tree.own(state.v), tree.own(state.a), tau);
        const Eigen::VectorXd expected =
            reference.rnea(tree.own(state.q), tree.own(state.v), tree.own(state.a));
        EXPECT_LT((tau - expected).cwiseAbs().maxCoeff(), 1e-10);
        ++checked;
      }
    }
    EXPECT_GE(checked, 12);
  }
}

/// Nothing drives legs that float: torques are those of stiffness and damping, and of nothing else.
TEST(Ladder, LegsFloat) {
  la::Task t = task("traverse_floating");
  for (const bool passive : {true, false}) {
    if (!passive) t.floating = la::Passive{};
    const la::Result r = la::traverse(t);
    const la::Plan plan = la::plan(t);
    const Joints first = plan.periods[0].first.q;
    double moved = 0;
    for (Eigen::Index k = 0; k < r.q.rows(); ++k)
      for (int j = la::kArms; j < la::kJoints; ++j) {
        const double expected = -t.floating->stiffness * (r.q(k, j) - first[j]) -
                                t.floating->damping * r.effort.rates(k, j);
        EXPECT_NEAR(r.effort.torques(k, j), expected, 1e-10);
        moved = std::max(moved, std::fabs(r.q(k, j) - first[j]));
      }
    EXPECT_GT(moved, 0.01);
    EXPECT_LT(r.power_balance, 1e-9);
    EXPECT_LT(r.hand_error, 1e-9);
    EXPECT_LE(passive ? r.limit_excess : 0, 0);
  }
}

/// In a plane, where all axes that move are y, segments turn as frames on them do.
TEST(Ladder, RatesOfSegments) {
  const la::Plan plan = la::plan(task("traverse"));
  using Of = std::pair<const char*, int>;
  const std::vector<Of> of[2] = {{{"r_elbow", la::kRightElbow},
                                  {"r_shoulder.y", la::kTorso},
                                  {"l_elbow", la::kLeftElbow},
                                  {"knee", la::kShanks}},
                                 {{"l_shoulder.y", la::kTorso},
                                  {"r_shoulder.y", la::kRightElbow},
                                  {"hip.y", la::kThighs},
                                  {"knee", la::kShanks}}};
  for (const la::Period& p : {plan.periods[2], plan.periods[3]}) {
    const la::Tree& tree = la::tree(p.held);
    la::State s = p.at(p.begin + 0.4 * p.duration());
    s.v[la::joint("hip.y")] = 0.7, s.v[la::joint("knee")] = -0.4;
    const la::Vector q = tree.own(s.q), v = tree.own(s.v);
    la::Vector rates;
    tree.segment_rates(q, v, rates);
    Eigen::Matrix<double, 6 * la::kFrames, la::kJoints> J;
    tree.jacobian(q, J.data());
    for (const Of& one : of[p.held]) {
      const int j = tree.joint(one.first);
      // The joint's axis is y or, where the tree is turned around, -y.
      const double expected = J.row(6 * one.second + 4).dot(v), axis = J(6 * one.second + 4, j);
      EXPECT_NEAR(std::fabs(axis), 1, 1e-12) << one.first;
      EXPECT_NEAR(rates[j], axis * expected, 1e-12) << one.first;
    }
  }
}

/// Velocities and accelerations of what is planned are derivatives of positions.
TEST(Ladder, MotionsAreSmooth) {
  for (const char* name : {"traverse", "traverse_stops"}) {
    const la::Plan plan = la::plan(task(name));
    for (const la::Period& p : plan.periods) {
      const double h = 1e-4 * p.duration();
      for (const double s : {0.2, 0.5, 0.9}) {
        const double t = p.begin + s * p.duration();
        const Joints v = (p.at(t + h).q - p.at(t - h).q) / (2 * h),
                     a = (p.at(t + h).v - p.at(t - h).v) / (2 * h);
        EXPECT_LT((v - p.at(t).v).cwiseAbs().maxCoeff(), 1e-5);
        EXPECT_LT((a - p.at(t).a).cwiseAbs().maxCoeff(), 1e-3);
      }
    }
    // Nothing jumps where the hands change.
    for (std::size_t k = 1; k < plan.periods.size(); ++k) {
      const la::State before = plan.periods[k - 1].at(plan.periods[k - 1].end),
                      after = plan.periods[k].at(plan.periods[k].begin);
      EXPECT_LT((before.q - after.q).cwiseAbs().maxCoeff(), 1e-10);
      EXPECT_LT((before.v - after.v).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LT((before.a - after.a).cwiseAbs().maxCoeff(), 1e-8);
    }
  }
}

/// Figures of the study, with room for a machine that does other things as well.
TEST(Ladder, IsFast) {
  const la::Tree& tree = la::tree(la::kRight);
  la::Vector q = la::Vector::Constant(la::kJoints, 0.3), v = q, a = q, tau;
  double call = 1, traverse = 1;
  for (int window = 0; window < 20; ++window) {
    const auto begin = std::chrono::steady_clock::now();
    for (int k = 0; k < 2000; ++k) tree.rnea(q, v, a, tau);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    call = std::min(call, taken.count() / 2000);
    traverse = std::min(traverse, la::traverse(task("traverse")).seconds);
  }
  RecordProperty("rnea_ns", std::to_string(1e9 * call));
  RecordProperty("traverse_ms", std::to_string(1e3 * traverse));
  std::printf("inverse dynamics %.0f ns, ten periods %.2f ms\n", 1e9 * call, 1e3 * traverse);
  EXPECT_LT(call, 1e-6);
  EXPECT_LT(traverse, 0.05);
}

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Ladder, Program) {
  const TempDir folder;
  const std::string out = std::string(folder.path()) + "/out";
  const Outcome run = run_program({LADDER, kTasks + "traverse.toml", "-o", out});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::filesystem::path at(out);
  const auto json = nlohmann::json::parse(content(at / "result.json"));
  EXPECT_LT(json["hand_error_m"].get<double>(), 1e-6);
  EXPECT_EQ(json["schedule"].size(), 10U);
  EXPECT_EQ(json["energy"].size(), 5U);
  for (const char* file : {"motion.csv", "peaks.csv", "schedule.csv", "weighted.svg", "torques.svg",
                           "motion.glb", "index.html"})
    EXPECT_GT(content(at / file).size(), 200U) << file;
  const auto status = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), LADDER);
    return run_program(arguments).status;
  };
  EXPECT_EQ(status({}), 1);
  EXPECT_EQ(status({"no_such_file.toml", "-o", out}), 2);
  EXPECT_EQ(status({kTasks + "both_hands.toml", "-o", out}), 0);
  EXPECT_EQ(status({kTasks + "both_hands.toml", "-o", "/proc/none"}), 3);
  std::ofstream(out + "/far.toml") << "[torso]\nx = -0.8\n";
  EXPECT_EQ(status({out + "/far.toml", "-o", out}), 5);
}

}  // namespace
}  // namespace arboc::test

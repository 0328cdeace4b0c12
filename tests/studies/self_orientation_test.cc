// Turning in zero gravity: what physics keeps, what the manoeuvre does, what the paper's formulas
// say.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/task_file.h"
#include "frontend/read_model.h"
#include "reference/reference.h"
#include "self_orientation/aim.h"
#include "self_orientation/paper.h"
#include "self_orientation/report.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

namespace so = self_orientation;
using so::Vector;

constexpr double kDegree = 3.14159265358979323846 / 180;
const std::string kTasks = ARBOC_SOURCE_DIR "/apps/self_orientation/tasks/";

so::Task task(const std::string& name) { return so::read_task(kTasks + name + ".toml"); }
so::Result run(const so::Task& t) { return so::report(so::model(t.model), t); }

/// Rounding of sums of some thousand terms of the size of 10 is far below these.
void expect_physics(const so::Result& r, const std::string& name) {
  EXPECT_GE(r.trajectory.times.size(), 1000U) << name;
  EXPECT_LT(r.momentum_drift, 1e-12) << name;
  EXPECT_LT(r.com_drift, 1e-9) << name;
  EXPECT_LT(r.base_residual, 1e-10) << name;
  EXPECT_LT(r.power_balance, 1e-9) << name;
  EXPECT_LT(r.closure, 1e-14) << name;
}

TEST(SelfOrientation, MomentumIsKept) {
  const so::Result r = run(task("turn"));
  expect_physics(r, "turn");
  EXPECT_GT(std::fabs(r.heading), 5 * kDegree);
}

TEST(SelfOrientation, SoOfTheHuman) {
  const so::Result r = run(task("human"));
  expect_physics(r, "human");
  EXPECT_GT(std::fabs(r.heading), 5 * kDegree);
  // The two bodies are built alike: legs of other masses turn them the same way.
  EXPECT_GT(r.heading * run(task("turn")).heading, 0);
}

TEST(SelfOrientation, BackwardsItTurnsTheOtherWay) {
  const so::Result there = run(task("turn")), back = run(task("turn_reversed"));
  EXPECT_NEAR(back.heading, -there.heading, 1e-9);
  const Eigen::Matrix3d R = so::orientation(so::model("astronaut_turn"), there.trajectory.q.back()),
                        S = so::orientation(so::model("astronaut_turn"), back.trajectory.q.back());
  EXPECT_LT((R * S - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(SelfOrientation, SlowlyItTurnsAsFarWithLessTorque) {
  so::Task slow = task("turn");
  slow.time_scale = 2;
  slow.rate /= 2;
  const so::Result one = run(task("turn")), two = run(slow);
  EXPECT_NEAR(two.heading, one.heading, 1e-9);
  ASSERT_EQ(two.torques.rows(), one.torques.rows());
  EXPECT_LT((4 * two.torques - one.torques).cwiseAbs().maxCoeff(), 1e-8);
}

/// Sixth order: halving the intervals divides the error by 64.
TEST(SelfOrientation, OrderOfTheIntegrator) {
  const so::Task t = task("turn");
  const so::Model& model = so::model(t.model);
  const so::Manoeuvre manoeuvre(t, model);
  const Eigen::Matrix3d exact = so::final_turn(model, manoeuvre, 200);
  const auto error = [&](int intervals) {
    return (so::final_turn(model, manoeuvre, intervals) - exact).norm();
  };
  const double coarse = error(8), fine = error(16);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_GT(coarse / fine, 45);
  EXPECT_LT(coarse / fine, 90);
}

TEST(SelfOrientation, AccelerationIsTheDerivativeOfVelocity) {
  for (const char* name : {"turn", "human"}) {
    const so::Task t = task(name);
    const so::Model& model = so::model(t.model);
    const so::Manoeuvre manoeuvre(t, model);
    const double h = 1e-3;
    for (const double at : {0.3, 0.75, 1.9, 2.6, 3.4, 4.1}) {
      const auto velocity = [&](double time) {
        const auto j = manoeuvre(time);
        return so::base_motion(model, model.at_origin(j.position), j.velocity, j.acceleration)
            .velocity;
      };
      const auto j = manoeuvre(at);
      const so::Vector6 a =
          so::base_motion(model, model.at_origin(j.position), j.velocity, j.acceleration)
              .acceleration;
      const so::Vector6 difference = (8 * (velocity(at + h) - velocity(at - h)) -
                                      velocity(at + 2 * h) + velocity(at - 2 * h)) /
                                     (12 * h);
      EXPECT_LT((a - difference).norm(), 1e-8) << name << " at " << at;
    }
  }
}

/// Spatial vectors in the reference frame and the generated code: the same motion, the same
/// torques.
TEST(SelfOrientation, FormulasOfThePaperAgree) {
  const so::Result r = run(task("turn"));
  ASSERT_TRUE(r.paper);
  EXPECT_LT(r.paper->velocity, 1e-12);
  EXPECT_LT(r.paper->acceleration, 1e-10);
  EXPECT_LT(r.paper->torque, 1e-10);
  EXPECT_LT(r.paper->momentum_rate, 1e-10);
}

TEST(SelfOrientation, ThreeBodiesAreThoseOfTheFile) {
  const so::ThreeBodies b = so::three_bodies(so::model("astronaut_turn"));
  EXPECT_NEAR(b.bodies[0].mass, 50.85, 1e-10);
  EXPECT_NEAR(b.bodies[0].inertia(2, 2), 0.883, 1e-10);
  for (int k = 1; k < 3; ++k) {
    EXPECT_NEAR(b.bodies[k].mass, 12.075, 1e-10);
    EXPECT_NEAR(b.bodies[k].centre.z(), -0.4146, 1e-12);
    EXPECT_NEAR(b.bodies[k].inertia(2, 2), 0.0296, 1e-12);
  }
  EXPECT_NEAR(b.hips[1].y(), 0.167, 1e-12);
}

/// Where one joint of a leg moves, its segment turns with the trunk and about its axis.
TEST(SelfOrientation, RatesOfSegments) {
  for (const char* name : {"astronaut_turn", "santos"}) {
    const so::Model& m = so::model(name);
    const Vector q = m.at_origin(m.start);
    for (const int j : {0, 1, static_cast<int>(m.joints.size()) - 1}) {
      Vector v = Vector::Zero(m.nv);
      v[6 + j] = 1.5;
      const Vector rates = m.segment_rates(q, v);
      EXPECT_NEAR(rates[j], 1.5, 1e-12) << name;
      v[6 + j] = 0;
      v.segment<3>(3) << 0.3, -0.2, 0.5;  // all segments turn with the trunk
      const Vector with = m.segment_rates(q, v);
      EXPECT_LE(std::fabs(with[j]), v.segment<3>(3).norm() + 1e-12);
      v.segment<3>(3) *= -1;
      EXPECT_NEAR(m.segment_rates(q, v)[j], -with[j], 1e-12);
    }
  }
  // Legs straight down: axes of the right hip are those of the trunk.
  const so::Model& m = so::model("astronaut_turn");
  Vector v = Vector::Zero(m.nv);
  v.segment<3>(3) << 0.3, -0.2, 0.5;
  const Vector rates = m.segment_rates(m.at_origin(Vector::Zero(6)), v);
  for (int leg = 0; leg < 2; ++leg)
    EXPECT_LT((rates.segment<3>(3 * leg) - v.segment<3>(3)).norm(), 1e-12);
}

/// The engine that reads the model's file: no force on the base, the same torques.
TEST(SelfOrientation, ReferenceAgrees) {
  for (const auto& [name, file] :
       {std::pair<const char*, const char*>{"turn", "astronaut_turn/astronaut_turn"},
        {"human", "santos/santos"}}) {
    Diagnostics diagnostics;
    ModelOptions options;
    options.base = Base::kFloating;
    Model model =
        read_model(std::string(ARBOC_SOURCE_DIR "/models/") + file + ".dh.toml", diagnostics);
    model = configure(model, options, diagnostics);
    model.gravity = {0, 0, 0};
    const Reference reference(model, {});
    const so::Result r = run(task(name));
    for (std::size_t k = 40; k < r.trajectory.times.size(); k += 150) {
      const Eigen::VectorXd tau =
          reference.rnea(r.trajectory.q[k], r.trajectory.v[k], r.trajectory.a[k]);
      EXPECT_LT(tau.head<6>().cwiseAbs().maxCoeff(), 1e-9) << name;
      EXPECT_LT((tau.tail(tau.size() - 6).transpose() - r.torques.row(static_cast<Eigen::Index>(k)))
                    .cwiseAbs()
                    .maxCoeff(),
                1e-9)
          << name;
    }
  }
}

TEST(SelfOrientation, FindsAHeading) {
  for (const double degrees : {90.0, -40.0}) {
    so::Task t = task("turn_90");
    t.aim.heading = degrees * kDegree;
    const so::Model& model = so::model(t.model);
    const so::AimResult aim = so::find_heading(model, t);
    ASSERT_TRUE(aim.found) << aim.reason;
    const so::Result r = run(aim.task);
    EXPECT_NEAR(r.heading, t.aim.heading, 1e-7);
    EXPECT_LT(r.tilt, 1e-6);
    expect_physics(r, "aim");
    for (const so::Step& step : aim.task.steps)
      for (const auto& [joint, angle] : step.q) {
        EXPECT_GE(angle, model.q_lower[model.joint(joint)] - 1e-8);
        EXPECT_LE(angle, model.q_upper[model.joint(joint)] + 1e-8);
      }
  }
}

TEST(SelfOrientation, AFarHeadingInOneCycleIsNotFound) {
  so::Task t = task("turn_90");
  t.aim.heading = 170 * kDegree;
  t.aim.most_cycles = 1;
  EXPECT_FALSE(so::find_heading(so::model(t.model), t).found);
}

TEST(SelfOrientation, LimitsAndNames) {
  so::Task t = task("turn");
  t.steps[0].q["r_hip.y"] = 60 * kDegree;
  EXPECT_THROW(run(t), std::invalid_argument);
  t.steps[0].q = {{"knee", 0}};
  EXPECT_THROW(run(t), std::invalid_argument);
}

std::string complaint_of(const std::string& path) {
  try {
    so::read_task(path);
  } catch (const study::TaskError& e) {
    return e.what();
  }
  return "";
}

TEST(SelfOrientation, StepsOfOneNameAndTimesWithoutEndAreRefused) {
  const TempDir folder;
  const std::string path = std::string(folder.path()) + "/task.toml";
  write_text(path, "base = \"" + kTasks + "turn.toml\"\nrate = inf\n");
  EXPECT_NE(complaint_of(path).find(":2:8: error: task: rate is not finite"), std::string::npos);
  const std::string step = "[[step]]\nname = \"x\"\nhome = true\n";
  write_text(path, "model = \"astronaut_turn\"\n" + step + step);
  EXPECT_NE(complaint_of(path).find("there are two steps of this name"), std::string::npos);
}

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(SelfOrientation, Program) {
  const TempDir folder;
  const std::string out = std::string(folder.path()) + "/out";
  const Outcome run = run_program({SELF_ORIENTATION, kTasks + "turn.toml", "-o", out});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::filesystem::path at(out);
  const auto json = nlohmann::json::parse(content(at / "result.json"));
  EXPECT_GT(std::fabs(json["heading_deg"].get<double>()), 5);
  EXPECT_LT(json["momentum_drift"].get<double>(), 1e-12);
  EXPECT_LT(json["com_drift_m"].get<double>(), 1e-9);
  EXPECT_EQ(json["energy"].size(), 5U);
  const std::string csv = content(at / "motion.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            json["frames"].get<std::size_t>() + 1);
  for (const char* file : {"peaks.csv", "torques.svg", "heading.svg", "motion.glb", "index.html"})
    EXPECT_GT(content(at / file).size(), 200U) << file;
  const auto status = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), SELF_ORIENTATION);
    return run_program(arguments).status;
  };
  EXPECT_EQ(status({}), 1);
  EXPECT_EQ(status({"no_such_file.toml", "-o", out}), 2);
  EXPECT_EQ(status({kTasks + "turn.toml", "-o", out, "--heading", "10"}), 2);
  EXPECT_EQ(status({kTasks + "turn.toml", "-o", "/proc/none"}), 3);
}

}  // namespace
}  // namespace arboc::test

// Motions of least torque: closed forms, derivatives, convergence, limits.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "optimal_control/report.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

namespace oc = optimal_control;
using oc::Vector;

const std::string kTasks = ARBOC_SOURCE_DIR "/apps/optimal_control/tasks/";

oc::Question question(const oc::Task& task) {
  oc::Known plan;
  return oc::question(task, plan);
}
oc::Question question(const std::string& name) {
  return question(oc::read_task(kTasks + name + ".toml"));
}

TEST(OptimalControl, OneJointIsKnownInClosedForm) {
  for (const oc::Method method : {oc::Method::kLagrangeNewton, oc::Method::kIpopt}) {
    const oc::Answer a = oc::solve(question("rotor"), method);
    ASSERT_TRUE(a.found) << a.stop_reason;
    EXPECT_NEAR(a.cost, 12, 1e-6) << oc::text(method);
    for (double t = 0; t <= 1; t += 0.05)
      EXPECT_NEAR(a.motion(t)[0], 3 * t * t - 2 * t * t * t, 1e-7) << oc::text(method);
  }
  // The quintic costs 120/7.
  const oc::Question q = question("rotor");
  EXPECT_NEAR(oc::torque_cost(*q.model, oc::quintic(Vector::Zero(1), Vector::Ones(1), 1), 1),
              120.0 / 7, 1e-10);
}

/// 12 X^2 / T^3; splines of any degree from 3 contain the cubic.
TEST(OptimalControl, ClosedFormScales) {
  oc::Task task = oc::read_task(kTasks + "rotor.toml");
  task.duration = 2.5;
  task.end["q"] = -0.7;
  for (const int degree : {3, 4, 5}) {
    task.degree = degree;
    const oc::Answer a = oc::solve(question(task), oc::Method::kLagrangeNewton);
    EXPECT_NEAR(a.cost, 12 * 0.49 / std::pow(2.5, 3), 1e-9) << degree;
    EXPECT_TRUE(a.minimum);
    EXPECT_LE(a.iterations, 2);  // a quadratic program
  }
}

TEST(OptimalControl, LagrangeNewtonConvergesQuadratically) {
  const oc::Answer a = oc::solve(question("lift"), oc::Method::kLagrangeNewton);
  ASSERT_TRUE(a.found) << a.stop_reason;
  EXPECT_TRUE(a.minimum);
  ASSERT_GE(a.log.size(), 4U);
  // Steps from 1e-1 on: each is at most a constant times the square of the one before.
  int pairs = 0;
  for (std::size_t k = 1; k < a.log.size(); ++k) {
    const double before = a.log[k - 1].dx, now = a.log[k].dx;
    if (a.log[k].shift != 0 || a.log[k].fraction != 1 || before > 0.1) continue;
    ++pairs;
    EXPECT_LT(now, std::max(before * before, 1e-9)) << "step " << k;
  }
  EXPECT_GE(pairs, 2);
  EXPECT_LT(a.violation, 1e-9);
  RecordProperty("milliseconds", std::to_string(1e3 * a.seconds));
}

/// No motion nearby that keeps the rows costs less.
TEST(OptimalControl, NothingNearbyCostsLess) {
  const oc::Question q = question("lift");
  const oc::Answer a = oc::solve(q, oc::Method::kLagrangeNewton);
  // Ends are held by the first and last two control points; the middle is free.
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const double best = oc::torque_cost(*q.model, oc::known(a.motion), q.duration);
  // The program's own quadrature has fewer points.
  EXPECT_NEAR(best, a.cost, 1e-3 * a.cost);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::MatrixXd points = a.motion.points();
    for (Eigen::Index k = 2; k < points.cols() - 2; ++k)
      for (Eigen::Index j = 0; j < points.rows(); ++j) points(j, k) += 0.02 * normal(random);
    EXPECT_GT(oc::torque_cost(*q.model, oc::known({a.motion.basis(), points}), q.duration), best);
  }
}

TEST(OptimalControl, LimitsAndReachHold) {
  const oc::Question q = question("lift");
  const oc::Answer a = oc::solve(q, oc::Method::kIpopt);
  ASSERT_TRUE(a.found) << a.stop_reason;
  EXPECT_LT(a.violation, 1e-7);
  const oc::Model& m = *q.model;
  Vector tau;
  for (int k = 0; k <= 400; ++k) {
    const double t = q.duration * k / 400;
    const Vector x = a.motion(t);
    m.rnea(x, a.motion(t, 1), a.motion(t, 2), tau);
    for (int j = 0; j < m.size(); ++j) {
      EXPECT_GE(x[j], m.q_lower[j] - 1e-7);
      EXPECT_LE(x[j], m.q_upper[j] + 1e-7);
      // Torques are limited at the Gauss points.
      EXPECT_LE(tau[j], 1.02 * m.tau_upper[j]);
      EXPECT_GE(tau[j], 1.02 * m.tau_lower[j]);
    }
  }
  std::vector<double> at(12 * m.frames.size());
  m.fk(a.motion(q.duration), at.data());
  const double* p = at.data() + 12 * m.frame("weight") + 9;
  EXPECT_NEAR(p[0], 0.35, 1e-7);
  EXPECT_NEAR(p[2], 1.4, 1e-7);
  EXPECT_LT(a.motion(q.duration, 1).norm(), 1e-6);
  EXPECT_LT(a.motion(0.0, 1).norm(), 1e-6);
  // Limits cost something, and less than the quintic does.
  EXPECT_LT(a.cost, oc::torque_cost(m, oc::quintic(a.motion(0), a.motion(q.duration), q.duration),
                                    q.duration));
}

/// Against the plan of a traverse: the same states at both ends, less torque.
TEST(OptimalControl, APeriodOfTheLadder) {
  oc::Known plan;
  const oc::Question q = oc::question(oc::read_task(kTasks + "ladder_period.toml"), plan);
  ASSERT_TRUE(plan);
  const oc::Result r = oc::report(q, {oc::Method::kLagrangeNewton, oc::Method::kIpopt}, 60, plan);
  for (const oc::Answer& a : r.answers) {
    ASSERT_TRUE(a.found) << a.stop_reason;
    EXPECT_LT(a.cost, 0.7 * r.before.cost);
    EXPECT_NEAR(a.cost, r.answers[0].cost, 1e-5 * a.cost);
    // The splines' own quadrature against a finer one.
    EXPECT_NEAR(a.cost, oc::torque_cost(*q.model, oc::known(a.motion), q.duration), 1e-2 * a.cost);
    Vector x, v, acceleration;
    for (const double t : {0.0, q.duration}) {
      plan(t, x, v, acceleration);
      EXPECT_LT((a.motion(t) - x).norm(), 1e-8);
      EXPECT_LT((a.motion(t, 1) - v).norm(), 1e-6);
      EXPECT_LT((a.motion(t, 2) - acceleration).norm(), 1e-4);
    }
  }
  EXPECT_TRUE(r.answers[0].minimum);
  EXPECT_EQ(r.before.energy.size(), 5U);
  EXPECT_LT(r.after[0].energy.at("effort"), r.before.energy.at("effort"));
}

TEST(OptimalControl, StopsAreReported) {
  oc::Question q = question("lift");
  q.max_iterations = 3;
  const oc::Answer a = oc::solve(q, oc::Method::kLagrangeNewton);
  EXPECT_FALSE(a.found);
  EXPECT_EQ(a.stop_reason, "as many iterations as allowed");
  EXPECT_EQ(a.iterations, 3);
}

/// x y = 1 nearest to the origin: (1, 1), multiplier -2 of x^2 + y^2 + l (x y - 1).
class Hyperbola : public nlp::Nlp {
 public:
  Hyperbola() {
    variables_.push(-nlp::kInfinity, nlp::kInfinity, 1);
    variables_.push(-nlp::kInfinity, nlp::kInfinity, 1);
    rows_.push(1, 1, 1);
    jacobian_.push(0, 0), jacobian_.push(0, 1);
    hessian_.push(0, 0), hessian_.push(1, 0), hessian_.push(1, 1);
  }
  nlp::Scales variables_, rows_;

  const nlp::Scales& variables() const override { return variables_; }
  const nlp::Scales& rows() const override { return rows_; }
  const std::vector<nlp::Group>& row_groups() const override { return groups_; }
  const std::vector<nlp::Group>& variable_groups() const override { return groups_; }
  const nlp::Pattern& jacobian_pattern() const override { return jacobian_; }
  const nlp::Pattern& hessian_pattern() const override { return hessian_; }
  void move_to(const double* x) override { x_ = {x[0], x[1]}; }
  double objective() override { return x_[0] * x_[0] + x_[1] * x_[1]; }
  const std::vector<double>& gradient() override { return g_ = {2 * x_[0], 2 * x_[1]}; }
  const std::vector<double>& constraints() override { return c_ = {x_[0] * x_[1]}; }
  const std::vector<double>& jacobian() override { return j_ = {x_[1], x_[0]}; }
  const std::vector<double>& hessian(double s, const double* l) override {
    return h_ = {2 * s, l[0], 2 * s};
  }

 private:
  std::vector<nlp::Group> groups_;
  nlp::Pattern jacobian_, hessian_;
  std::vector<double> x_, g_, c_, j_, h_;
};

TEST(LagrangeNewton, Hyperbola) {
  for (const bool safeguards : {false, true}) {
    Hyperbola h;
    nlp::LagrangeNewtonOptions options;
    options.safeguards = safeguards;
    const auto r = nlp::lagrange_newton(h, {1.3, 0.9}, options);
    ASSERT_TRUE(r.converged) << r.stop_reason;
    EXPECT_NEAR(r.x[0], 1, 1e-12);
    EXPECT_NEAR(r.x[1], 1, 1e-12);
    EXPECT_NEAR(r.multipliers[0], -2, 1e-12);
    EXPECT_TRUE(r.minimum);
  }
}

TEST(LagrangeNewton, SafeguardsLeadFromFurtherAway) {
  Hyperbola h;
  const auto r = nlp::lagrange_newton(h, {9, -2}, {200, 1e-9, true});
  ASSERT_TRUE(r.converged) << r.stop_reason;
  EXPECT_NEAR(r.objective, 2, 1e-10);
  EXPECT_TRUE(r.minimum);
}

TEST(LagrangeNewton, InequalitiesAndDependentRowsAreRefused) {
  Hyperbola h;
  h.rows_.upper[0] = 2;
  EXPECT_THROW(nlp::lagrange_newton(h, {1, 1}), std::invalid_argument);
  Hyperbola bounded;
  bounded.variables_.lower[0] = 0;
  EXPECT_THROW(nlp::lagrange_newton(bounded, {1, 1}), std::invalid_argument);
  Hyperbola at_origin;  // the row has no gradient there
  const auto r = nlp::lagrange_newton(at_origin, {0, 0});
  EXPECT_FALSE(r.converged);
  EXPECT_NE(r.stop_reason, "");
}

std::string content(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(OptimalControl, Program) {
  const TempDir folder;
  const std::string out = std::string(folder.path()) + "/out";
  const Outcome run = run_program({OPTIMAL_CONTROL, kTasks + "lift.toml", "-o", out});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::filesystem::path at(out);
  const auto json = nlohmann::json::parse(content(at / "result.json"));
  EXPECT_GT(json["cost"].get<double>(), 0);
  EXPECT_GT(json["iterations"].get<int>(), 0);
  EXPECT_EQ(json["stop_reason"], "|dx| << |x| and |dl| << |l|");
  EXPECT_EQ(json["answers"].size(), 2U);
  EXPECT_EQ(json["before"]["energy"].size(), 5U);
  EXPECT_LT(json["cost"].get<double>(), json["before"]["cost"].get<double>());
  for (const char* file :
       {"motion.csv", "cost.svg", "torques.svg", "motion.glb", "index.html", "lagrange_newton.csv"})
    EXPECT_GT(content(at / file).size(), 200U) << file;
  const auto status = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), OPTIMAL_CONTROL);
    return run_program(arguments).status;
  };
  EXPECT_EQ(status({}), 1);
  EXPECT_EQ(status({"no_such_file.toml", "-o", out}), 2);
  EXPECT_EQ(status({kTasks + "rotor.toml", "-o", "/proc/none"}), 3);
  std::filesystem::copy(kTasks + "lift.toml", out + "/lift.toml");
  std::ofstream(out + "/few.toml") << "base = \"lift.toml\"\nmax_iterations = 2\n";
  EXPECT_EQ(status({out + "/few.toml", "-o", out}), 5);
}

}  // namespace
}  // namespace arboc::test

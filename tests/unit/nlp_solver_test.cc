// Solving: known solutions, what is said where there is none, warm starts.
#include <gtest/gtest.h>

#include <arboc/nlp/relax.hpp>
#include <arboc/nlp/scalars.hpp>
#include <cmath>

#include "unit/nlp_support.h"

namespace arboc::test {
namespace {

using namespace nlp;

/// min x^2 + y^2 on the line 3 x + 4 y = `c`, in units of which one is a thousand times the other.
Problem line(double c) {
  Problem p;
  const auto x = p.add_variables("x", "m", {{-kInfinity, kInfinity, 1}, {-kInfinity, 10, 1000}});
  const int g = p.add_group("line", "m");
  p.require(g, 3 * x[0] + 4 * x[1], c, c, 10);
  p.minimise("distance", 1, square(), {x[0]});
  p.minimise("distance", 1, square(), {x[1]});
  return p;
}

TEST(Solver, FindsTheOptimumInItsOwnUnits) {
  Assembly nlp(line(25));
  const Solution s = solve(nlp, {0, 0});
  EXPECT_EQ(s.status, Status::kOptimal) << s.reason;
  EXPECT_NEAR(s.x[0], 3, 1e-7);
  EXPECT_NEAR(s.x[1], 4, 1e-7);
  EXPECT_NEAR(s.multipliers.rows[0], -2, 1e-7);  // gradient 2 (3, 4) = -lambda (3, 4)
  EXPECT_NEAR(s.objective, 25, 1e-6);
  EXPECT_LT(s.kkt_error, 1e-7);
  EXPECT_LT(s.violation, 1e-8);
  EXPECT_GT(s.seconds, 0);
}

TEST(Solver, BoundsHoldAndHaveMultipliers) {
  Problem p = line(25);
  Assembly nlp(p);
  nlp.set_variable(0, -1, 1);
  const Solution s = solve(nlp, {0, 0});
  EXPECT_EQ(s.status, Status::kOptimal) << s.reason;
  EXPECT_NEAR(s.x[0], 1, 1e-6);
  EXPECT_LE(s.x[0], 1.0);
  EXPECT_NEAR(s.x[1], 5.5, 1e-6);
  EXPECT_NEAR(s.multipliers.upper[0], 3 * 11.0 / 4 - 2, 1e-5);  // 2 x + 3 lambda + z = 0
}

TEST(Solver, AWarmStartTakesFewerIterations) {
  // The classic problem 71 of Hock and Schittkowski.
  Problem p;
  const auto x = p.add_variables("x", "1", std::vector<Interval>(4, {1, 5, 1}));
  const auto q = p.add_variables("q", "1", std::vector<Interval>(2));
  const int g = p.add_group("product", "1"), h = p.add_group("sphere", "1");
  p.require(g, dot(1), {x[0], x[3]}, -Affine(q[0]), 0, 0);
  p.require(g, dot(1), {x[1], x[2]}, -Affine(q[1]), 0, 0);
  p.require(g, dot(1), {q[0], q[1]}, {}, 25, kInfinity);
  p.require(h, squared_norm(4), {x[0], x[1], x[2], x[3]}, {}, 40, 40);
  p.minimise("f", 1, dot(1), {q[0], x[0] + x[1] + x[2]});
  p.minimise("f", 1, x[2]);
  Assembly nlp(p);
  const Solution cold = solve(nlp, {1, 5, 5, 1, 1, 25});
  ASSERT_EQ(cold.status, Status::kOptimal) << cold.reason;
  EXPECT_NEAR(cold.objective, 17.0140173, 1e-6);
  SolverOptions options;
  options.warm = &cold.multipliers;
  nlp.set_row(h, 0, 40.1, 40.1);
  const Solution warm = solve(nlp, cold.x, options);
  EXPECT_EQ(warm.status, Status::kOptimal) << warm.reason;
  EXPECT_LT(warm.iterations, cold.iterations);
}

TEST(Solver, StopsWhenToldTo) {
  Assembly nlp(line(25));
  SolverOptions options;
  options.go_on = [](const Progress& p) { return p.iteration < 1; };
  EXPECT_EQ(solve(nlp, {100, 100}, options).status, Status::kStopped);
  options = {};
  options.max_iterations = 0;
  const Solution s = solve(nlp, {100, 100}, options);
  EXPECT_EQ(s.status, Status::kStopped);
  EXPECT_EQ(s.reason, "the iteration limit was reached");
}

/// Far from its start Newton's method on Rosenbrock's valley goes up and down: the last is not
/// best.
TEST(Solver, StoppedItGivesTheBestPointSoFar) {
  Problem p;
  const auto x = p.add_variables("x", "m", std::vector<Interval>(2, {-kInfinity, kInfinity, 1}));
  const auto q = p.add_variables("q", "m^2", std::vector<Interval>(1));
  const int g = p.add_group("square", "m^2");
  p.require(g, square(), {x[0]}, -Affine(q[0]), 0, 0);
  p.minimise("valley", 100, square(), {x[1] - q[0]});
  p.minimise("end", 1, square(), {1 - x[0]});
  Assembly nlp(p);
  for (const int last : {1, 2}) {
    SolverOptions options;
    std::vector<Progress> seen;
    options.go_on = [&](const Progress& at) {
      seen.push_back(at);
      return at.iteration < last;
    };
    const Solution s = solve(nlp, {-1.2, 1, 1.44}, options);
    EXPECT_EQ(s.status, Status::kStopped);
    ASSERT_EQ(seen.size(), static_cast<std::size_t>(last) + 1);
    double least = kInfinity;
    for (const Progress& at : seen) {
      EXPECT_NEAR(at.violations[0].largest, at.violation, 1e-12) << at.iteration;
      least = std::min(least, at.violation);
    }
    EXPECT_NEAR(s.violation, least, 1e-12);
  }
}

/// An arm of two links of length 1 about the origin: (cos a + cos b, sin a + sin b).
class Arm : public Function {
 public:
  Arm() {
    for (int r = 0; r < 2; ++r)
      for (int c = 0; c < 2; ++c) jacobian_.push(r, c);
    hessian_.push(0, 0);
    hessian_.push(1, 1);
  }
  int inputs() const override { return 2; }
  int outputs() const override { return 2; }
  const Pattern& jacobian_pattern() const override { return jacobian_; }
  const Pattern& hessian_pattern() const override { return hessian_; }
  void values(int, const double* x, double* y) override {
    y[0] = std::cos(x[0]) + std::cos(x[1]);
    y[1] = std::sin(x[0]) + std::sin(x[1]);
  }
  void jacobian(int, const double* x, double* J) override {
    for (int c = 0; c < 2; ++c) {
      J[c] = -std::sin(x[c]);
      J[2 + c] = std::cos(x[c]);
    }
  }
  void hessian(int, const double* x, const double* w, double* H) override {
    for (int c = 0; c < 2; ++c) H[c] = -w[0] * std::cos(x[c]) - w[1] * std::sin(x[c]);
  }

 private:
  Pattern jacobian_, hessian_;
};

TEST(Diagnosis, SaysHowFarOffAndWhatHolds) {
  Problem p;
  const auto q = p.add_variables("joint limits", "rad", std::vector<Interval>(2, {-3, 3, 1}));
  const auto tip = p.evaluate(std::make_shared<Arm>(), {q[0], q[1]});
  const int target = p.add_group("target", "m"), wall = p.add_group("wall", "m");
  p.require(target, tip[0], 1.5, 1.5);
  p.require(target, tip[1], 2.0, 2.0);
  p.require(wall, tip[0], -kInfinity, 3);
  p.minimise("rest", 1, square(), {q[0]});
  Assembly nlp(p);
  const Solution s = solve(nlp, {0.1, 0.2});
  EXPECT_NE(s.status, Status::kOptimal);
  const Diagnosis d = diagnose(nlp, s.x, {target});
  EXPECT_FALSE(d.feasible);
  ASSERT_TRUE(d.has_nearest);
  EXPECT_NEAR(d.nearest, 0.5, 1e-6);  // the target is 2.5 away, the arm 2 long
  ASSERT_FALSE(d.conflicts.empty());
  EXPECT_EQ(d.conflicts[0].group, "target");
  EXPECT_TRUE(d.held_by.empty());  // nothing but its own length

  nlp.set_row(wall, 0, -kInfinity, 1);
  const Diagnosis held = diagnose(nlp, {0.5, 1.0}, {target});
  ASSERT_TRUE(held.has_nearest);
  EXPECT_NEAR(held.nearest, std::hypot(0.5, 2 - std::sqrt(3.0)), 1e-6);
  ASSERT_EQ(held.held_by.size(), 1U);
  EXPECT_EQ(held.held_by[0], "wall");
}

TEST(Diagnosis, SaysThatThereIsASolutionAfterAll) {
  Assembly nlp(line(25));
  const Diagnosis d = diagnose(nlp, {0, 0}, {0});
  EXPECT_TRUE(d.feasible);
  EXPECT_TRUE(d.conflicts.empty());
}

TEST(Violations, AreNamedAndInTheirUnits) {
  Assembly nlp(line(25));
  const auto all = violations(nlp, {1, 12});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].name, "line");
  EXPECT_DOUBLE_EQ(all[0].largest, 26);
  EXPECT_EQ(all[1].unit, "m");
  EXPECT_DOUBLE_EQ(all[1].largest, 2);
  EXPECT_DOUBLE_EQ(largest_violation(nlp, {1, 12}), 2.6);  // rows count in tens
}

}  // namespace
}  // namespace arboc::test

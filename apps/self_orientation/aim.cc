#include "aim.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <arboc/nlp/assembly.hpp>
#include <arboc/nlp/scalars.hpp>
#include <chrono>
#include <cmath>

namespace self_orientation {
namespace {

namespace nlp = arboc::nlp;

constexpr int kCoarse = 8, kFine = 40;  ///< intervals of each step: headings to 1e-5, 1e-10
/// Of differences of fourth order, whose error is of the order of 1e-3^4; rad.
constexpr double kStep = 2e-3;

void set(Task& task, const std::vector<Free>& free, const double* x) {
  for (std::size_t k = 0; k < free.size(); ++k)
    for (Step& step : task.steps)
      if (step.name == free[k].step) step.q.at(free[k].joint) = x[k];
}

/// Free angles -> rotation vector of one cycle, along the base's axes at the start.  The angles of
/// a manoeuvre are few, so differences are cheap.
class Turn : public nlp::Function {
 public:
  Turn(const Model& model, Task task, int intervals)
      : model_(model), task_(std::move(task)), intervals_(intervals) {
    task_.cycles = 1;
    for (int i = 0; i < inputs(); ++i) {
      for (int r = 0; r < 3; ++r) jacobian_.push(r, i);
      for (int j = 0; j <= i; ++j) hessian_.push(i, j);
    }
  }
  int inputs() const override { return static_cast<int>(task_.aim.free.size()); }
  int outputs() const override { return 3; }
  const nlp::Pattern& jacobian_pattern() const override { return jacobian_; }
  const nlp::Pattern& hessian_pattern() const override { return hessian_; }

  void values(int n, const double* x, double* y) override {
    for (int s = 0; s < n; ++s)
      Eigen::Map<Eigen::Vector3d>(y + 3 * s) =
          turn(Eigen::Map<const Vector>(x + s * inputs(), inputs()));
  }
  void jacobian(int n, const double* x, double* entries) override {
    for (int s = 0; s < n; ++s) {
      const Vector at = Eigen::Map<const Vector>(x + s * inputs(), inputs());
      for (int i = 0; i < inputs(); ++i, entries += 3) {
        const auto along = [&](double h) { return turn(at + h * Vector::Unit(inputs(), i)); };
        Eigen::Map<Eigen::Vector3d>{entries} =
            (8 * (along(kStep) - along(-kStep)) - along(2 * kStep) + along(-2 * kStep)) /
            (12 * kStep);
      }
    }
  }
  void hessian(int n, const double* x, const double* weights, double* entries) override {
    const double h = 5 * kStep;
    for (int s = 0; s < n; ++s) {
      const Vector at = Eigen::Map<const Vector>(x + s * inputs(), inputs());
      const Eigen::Map<const Eigen::Vector3d> w(weights + 3 * s);
      const double here = w.dot(turn(at));
      const auto value = [&](int i, double a, int j, double b) {
        return w.dot(turn(at + a * Vector::Unit(inputs(), i) + b * Vector::Unit(inputs(), j)));
      };
      for (int i = 0; i < inputs(); ++i)
        for (int j = 0; j <= i; ++j)
          *entries++ = i == j ? (value(i, h, i, 0) - 2 * here + value(i, -h, i, 0)) / (h * h)
                              : (value(i, h, j, h) - value(i, h, j, -h) - value(i, -h, j, h) +
                                 value(i, -h, j, -h)) /
                                    (4 * h * h);
    }
  }

 private:
  Eigen::Vector3d turn(const Vector& angles) {
    set(task_, task_.aim.free, angles.data());
    const Eigen::AngleAxisd r(final_turn(model_, Manoeuvre(task_, unlimited()), intervals_));
    return r.angle() * r.axis();
  }
  /// Differences may go a hair beyond the limits.
  const Model& unlimited() {
    if (free_.name.empty()) {
      free_ = model_;
      free_.q_lower.setConstant(-HUGE_VAL);
      free_.q_upper.setConstant(HUGE_VAL);
    }
    return free_;
  }

  const Model& model_;
  Model free_{};
  Task task_;
  int intervals_;
  nlp::Pattern jacobian_, hessian_;
};

/// What is asked of one cycle: a heading by the least angles, or the largest of a sign.
struct Wish {
  double heading = 0;   ///< rad
  double farthest = 0;  ///< not 0: as far as can be in this direction, instead
};

nlp::Solution solve_for(const Model& model, const Task& task, const Wish& wish, int intervals,
                        std::vector<double> start) {
  nlp::Problem p;
  std::vector<nlp::Interval> intervals_of;
  std::vector<nlp::Affine> inputs;
  for (const Free& f : task.aim.free) {
    const int j = model.joint(f.joint);
    intervals_of.push_back({model.q_lower[j], model.q_upper[j], 1});
  }
  const auto x = p.add_variables("angles", "rad", intervals_of);
  for (int i = 0; i < x.count; ++i) {
    inputs.push_back(x[i]);
    const nlp::Interval& range = intervals_of[static_cast<std::size_t>(i)];
    if (wish.farthest == 0)
      p.minimise("angles", 1 / std::pow(range.upper - range.lower, 2), nlp::square(), {x[i]});
  }
  const auto y = p.evaluate(std::make_shared<Turn>(model, task, intervals), inputs);
  const int wanted = p.add_group("heading", "rad"), upright = p.add_group("tilt", "rad");
  if (wish.farthest == 0)
    p.require(wanted, y[model.up], wish.heading, wish.heading);
  else
    p.minimise("heading", -wish.farthest, y[model.up]);
  for (int axis = 0; axis < 3; ++axis)
    if (axis != model.up) p.require(upright, y[axis], 0, 0);
  nlp::Assembly problem(p);
  nlp::SolverOptions options;
  options.tolerance = wish.farthest == 0 ? 1e-7 : 1e-4;
  options.row_tolerance = wish.farthest == 0 ? 1e-10 : 1e-5;
  options.max_iterations = 60;
  return nlp::solve(problem, std::move(start), options);
}

}  // namespace

AimResult find_heading(const Model& model, const Task& task) {
  const auto begin = std::chrono::steady_clock::now();
  AimResult result;
  result.task = task;
  std::vector<double> angles;
  for (const Free& f : task.aim.free)
    for (const Step& step : task.steps)
      if (step.name == f.step) angles.push_back(step.q.at(f.joint));
  const auto solve = [&](const Wish& wish, int intervals) {
    const nlp::Solution s = solve_for(model, task, wish, intervals, angles);
    result.iterations += s.iterations;
    result.reason = s.reason;
    if (s.status == nlp::Status::kOptimal) angles = s.x;
    return s;
  };
  // How far one cycle can turn says how many are needed.
  const nlp::Solution most = solve({0, task.aim.heading < 0 ? -1.0 : 1.0}, kCoarse);
  const double reach = std::max(std::fabs(most.objective), 1e-3);
  const int cycles = std::max(1, static_cast<int>(std::ceil(std::fabs(task.aim.heading) / reach)));
  if (cycles > task.aim.most_cycles) {
    result.reason =
        fmt::format("a cycle turns by {:.1f} degrees at most: more cycles are needed than allowed",
                    reach * 180 / 3.14159265358979);
  } else {
    const Wish wish{task.aim.heading / cycles, 0};
    solve(wish, kCoarse);
    result.found = solve(wish, kFine).status == nlp::Status::kOptimal;
    set(result.task, task.aim.free, angles.data());
    result.task.cycles = cycles;
  }
  result.heading = heading(final_turn(model, Manoeuvre(result.task, model), kFine), model.up).turn;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace self_orientation

// Minimum torque over B-splines: [Astronaut] section 6.
//
//   minimise Int sum tau_k^2 dt over control points, subject to C(control points) = 0
// The integral is by Gauss points a span; the torques at each are a generated function of sums of
// control points, so gradients and Hessians are exact and sparse.
#pragma once
#include <arboc/motion/bspline.hpp>
#include <arboc/nlp/lagrange_newton.hpp>
#include <arboc/nlp/solver.hpp>

#include "models.h"
#include "task.h"

namespace optimal_control {

/// A motion that is known already, as guess and to compare with.
using Known = std::function<void(double t, Vector& q, Vector& v, Vector& a)>;

/// A state at one end of the motion; what is not there is free.
struct End {
  Vector q, v, a;
};

/// What is to be found.
struct Question {
  const Model* model = nullptr;
  double duration = 1;
  End start, end;
  std::optional<Reach> reach;  ///< at the end, instead of end.q
  arboc::BSplineBasis basis = arboc::BSplineBasis::clamped_uniform(3, 4, 0, 1);
  int points_per_span = 4;
  double smoothness = 0;
  Eigen::MatrixXd guess;  ///< control points: joints x points
  bool limits = true;
  int max_iterations = 50;
};
/// With the plan of a ladder's period in `plan`; otherwise that stays empty.
Question question(const Task& task, Known& plan);

struct Answer {
  Method method = Method::kLagrangeNewton;
  bool found = false;
  std::string stop_reason;
  double cost = 0;  ///< Int sum tau^2 dt, N^2 m^2 s
  int iterations = 0;
  bool minimum = false;  ///< Lagrange-Newton: second-order conditions hold
  double violation = 0;  ///< largest, of rows; rad, m, N m
  double seconds = 0;
  std::vector<arboc::nlp::LagrangeNewtonStep> log;
  arboc::BSpline motion;
};
Answer solve(const Question& question, Method method);

/// Int sum tau^2 dt of a motion, by `points` Gauss points on each of `spans` parts.
double torque_cost(const study::FixedModel& model, const Known& motion, double duration,
                   int spans = 40, int points = 5);
Known known(const arboc::BSpline& motion);
/// Quintics in the joints from rest to rest, [Astronaut] (1).
Known quintic(const Vector& from, const Vector& to, double duration);

}  // namespace optimal_control

// The search for a posture: from each start onto what holds the body, then to the objective; of all
// starts the best.  Where none succeeds, what conflicts.
#pragma once
#include <arboc/nlp/relax.hpp>
#include <random>

#include "build.h"

namespace posture {

/// One start, with what it took.
struct Start {
  arboc::nlp::Status status = arboc::nlp::Status::kStopped;
  std::string reason;
  double objective = 0, kkt_error = 0, violation = 0;
  int iterations = 0, restarts = 0;
  double seconds = 0;             ///< all of it
  double cpu_seconds = 0;         ///< of the process meanwhile
  double derivative_seconds = 0;  ///< in functions and their assembly
  double hessian_seconds = 0;     ///< of these in second derivatives
  std::vector<double> q;
};

/// A solution again, after the first target has moved.
struct Again {
  arboc::nlp::Status status = arboc::nlp::Status::kStopped;
  int iterations = 0;
  double seconds = 0, cpu_seconds = 0, objective = 0;
};

struct Result {
  arboc::nlp::Status status = arboc::nlp::Status::kStopped;
  std::string reason;
  double objective = 0;
  /// All measures of the objective, unweighted, whether asked for or not.
  std::map<std::string, double> measures;
  double kkt_error = 0, max_violation = 0, max_normalised_torque = 0;
  int iterations = 0;
  double seconds = 0;                            ///< of all starts and what follows
  std::vector<double> q, tau;                    ///< tau: of all coordinates
  std::vector<std::array<double, 6>> reactions;  ///< of contacts, on the body, at the point, world
  std::vector<arboc::nlp::GroupViolation> violations;
  std::vector<std::string> active;  ///< limits that hold back
  /// Of the problem: variables, of these fixed, equalities, inequalities, Jacobian, Hessian
  /// entries.
  std::array<int, 6> size{};
  std::vector<Start> starts;
  int best = -1;
  arboc::nlp::Diagnosis diagnosis;  ///< where there is no solution
  std::optional<Again> again;
};

/// `move`: the first target, a point, then moves by this, and the best solution is warm-started.
Result predict(const Task& task, const Model& model, const std::optional<Vector3>& move = {});

/// Fills in what x, a point of `built`, is worth: posture, torques, reactions, measures,
/// violations.
void report(const Task& task, const Model& model, const Built& built, const std::vector<double>& x,
            Result& result);
/// In words, with lengths in mm: how far off, and what holds.
std::string explanation(const arboc::nlp::Diagnosis& diagnosis);

/// The posture from which start k begins: the guess, and others in the ranges of the joints.
std::vector<double> start_posture(const Task& task, const Model& model, int k, int restart);

}  // namespace posture

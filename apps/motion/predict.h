// The way to a motion: postures at both ends, a straight line between them, the problem without and
// with torques in the objective, more control points until the audit passes.
#pragma once
#include "audit.h"
#include "ends.h"

namespace motion {

/// A problem that was solved, with what it took.
struct Stage {
  std::string name;
  arboc::nlp::Status status = arboc::nlp::Status::kStopped;
  std::string reason;
  int control_points = 0, frames = 0, contact_frames = 0, torque_frames = 0;
  std::size_t variables = 0, rows = 0, jacobian = 0, hessian = 0;  ///< sizes and entries
  int iterations = 0;
  double objective = 0, kkt_error = 0, violation = 0;
  std::vector<double> maxima;  ///< a phase; of n at frames and ends, 0 where that is no objective
  double seconds = 0, cpu_seconds = 0, build_seconds = 0;
  double derivative_seconds = 0, hessian_seconds = 0;
  arboc::nlp::EvaluationTime time{};
  Audit audit;
};

struct Result {
  arboc::nlp::Status status = arboc::nlp::Status::kStopped;
  std::string reason;
  bool audit_passes = false;
  double seconds = 0, posture_seconds = 0;
  posture::Result start, end;
  std::vector<Stage> stages;
  std::optional<Motion> motion;
  Samples samples;  ///< at ten times the frames, at least 401 instants
  Audit audit;
  std::map<std::string, double> measures;
};

/// What a caller sees of an iteration; false stops with what there is.
struct Iteration {
  const Stage& stage;
  arboc::nlp::Progress progress;
  double seconds;
};
using GoOn = std::function<bool(const Iteration&)>;

struct Options {
  GoOn go_on = {};
  std::vector<Motion> from = {};  ///< where to start, one a phase; otherwise straight lines
  bool reactions_only = false;    ///< of `from`
  int threads = 2;                ///< of functions
  int blas_threads = 1;           ///< of the linear solver
  std::string label = {};         ///< before the names of stages
  Joints joints = {};             ///< at the first start and the last end
};

Result predict(const Task& task, const Model& model, const Options& options = {});
/// Phases that are linked each to the next, in one problem.  One result a phase; stages and
/// seconds, which are those of all, are with the first.
std::vector<Result> predict_chain(const std::vector<Task>& tasks, const Model& model,
                                  const Options& options = {});

/// The stages, one by one, after predict_ends.  A motion on the bases of the task:
Motion first_guess(const Task& task, const Ends& ends);
/// From the guesses, on their bases.
std::vector<Motion> improve(const Model& model, const std::vector<Part>& parts, Stage& stage,
                            const Options& options);
/// The best reactions for motions that are given, a convex problem; on their bases.
std::vector<Motion> react(const Model& model, const std::vector<Part>& parts, Stage& stage,
                          const Options& options);

}  // namespace motion

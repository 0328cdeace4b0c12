// The way to a motion: postures at both ends, a straight line between them, the problem without and
// with torques in the objective, more control points until the audit passes.
#pragma once
#include <posture/predict.h>

#include "audit.h"

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
  double maximum = 0;  ///< of n at frames and ends, where that is part of the objective
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

/// What comes before and after, of a motion in phases.
struct Joints {
  std::optional<State> after = {};  ///< where the motion before ended: this one begins there
  bool jolts = false;               ///< other than `given`, see Ends: a contact is new while moving
  const Task* next = nullptr;       ///< whose contacts do not move at the end either
};

struct Options {
  GoOn go_on = {};
  std::optional<Motion> from = {};  ///< where to start; otherwise a straight line
  bool reactions_only = false;      ///< of `from`
  int threads = 2;                  ///< of functions
  int blas_threads = 1;             ///< of the linear solver
  std::string label = {};           ///< before the names of stages
  Joints joints = {};
};

Result predict(const Task& task, const Model& model, const Options& options = {});

/// The stages, one by one.  Postures and reactions at both ends:
Ends predict_ends(const Task& task, const Model& model, posture::Result& start,
                  posture::Result& end, const Joints& joints = {});
/// A motion on the bases of the task.
Motion first_guess(const Task& task, const Ends& ends);
/// From `guess`, on its bases.
Motion improve(const Task& task, const Model& model, const Ends& ends, const Motion& guess,
               Stage& stage, const Options& options);
/// The best reactions for a motion that is given, a convex problem; on the bases of `given`.
Motion react(const Task& task, const Model& model, const Ends& ends, const Motion& given,
             Stage& stage, const Options& options);

/// How a motion moves at one of its ends.
State state_at(const Motion& motion, bool at_end);

}  // namespace motion

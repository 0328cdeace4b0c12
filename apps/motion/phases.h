// Motions in phases, such as a lean that goes on into a squat, or a step and then the next one:
// each begins in the state in which the one before ended.
//
// Phases between which the body moves are one problem, whose joints are where all of them are best
// served; where it rests, one is solved after the other.  Across a joint coordinates and velocities
// are continuous; so are accelerations, reactions and torques, but where the body moves and a
// contact is new.
#pragma once
#include "predict.h"

namespace motion {

struct Course {
  arboc::nlp::Status status = arboc::nlp::Status::kStopped;
  std::string reason;
  bool audit_passes = false;  ///< of all phases
  double seconds = 0;
  std::vector<Result> phases;  ///< up to the first that failed
};

/// As all tasks of a file say; `from`: where each starts, or nothing.
/// Throws std::invalid_argument where phases do not fit.
Course predict_phases(const Plan& plan, const Model& model, const Options& options,
                      const std::vector<Motion>& from = {});

/// All phases as one task and one result, to be shown: with the contacts of all of them, none of
/// which pushes while it does not hold; its motion is that of the only phase, or none.
Task whole(const Plan& plan);
Result whole(const Plan& plan, const Course& course);

/// The curves of each phase in a result.json of the same model and contacts, stretched to the
/// tasks' durations.  Throws std::invalid_argument.
std::vector<Motion> read_motions(const std::string& path, const Model& model, const Plan& plan);

}  // namespace motion

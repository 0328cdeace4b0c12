// Result -> files.
#pragma once
#include "common/recording.h"
#include "phases.h"

namespace motion {

using study::Recording;

/// result.json: everything but the curves in time; numbers with 17 digits.  Phases, where there are
/// several, have one object each in it.
std::string json_text(const Plan& plan, const Model& model, const Course& course);
/// One row an instant: t, then coordinates, velocities, accelerations, torques.
std::string trajectory_csv(const Model& model, const Result& result);
/// One row an instant: t, then force and moment of each contact, on the body, world axes.
std::string reactions_csv(const Task& task, const Result& result);

/// For OpenSim: angles in degrees, torques of driven coordinates, reactions as external loads; and
/// the frames as markers.
Recording coordinates_recording(const Model& model, const Result& result);
Recording torques_recording(const Model& model, const Result& result);
Recording reactions_recording(const Task& task, const Model& model, const Result& result);
Recording markers_recording(const Task& task, const Model& model, const Result& result);

}  // namespace motion

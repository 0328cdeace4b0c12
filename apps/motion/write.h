// Result -> files.
#pragma once
#include "predict.h"

namespace motion {

/// result.json: everything but the curves in time; numbers with 17 digits.
std::string json_text(const Task& task, const Model& model, const Result& result);
/// One row an instant: t, then coordinates, velocities, accelerations, torques.
std::string trajectory_csv(const Model& model, const Result& result);
/// One row an instant: t, then force and moment of each contact, on the body, world axes.
std::string reactions_csv(const Task& task, const Result& result);

}  // namespace motion

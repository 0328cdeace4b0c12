// The functions that arboc generates: their names, signatures, and the algorithm behind each.
//
// To add one: write the algorithm (algorithms/), a method of Engine (engine.h), a row of the table
// in catalogue.cc, a line of docs/functions.md, and its truth (record.cc).
#pragma once
#include <string>
#include <vector>

#include "emit/target.h"
#include "functions/engine.h"
#include "functions/request.h"
#include "functions/setup.h"

namespace arboc {

/// All names, in the order of the documentation.
std::vector<std::string> function_names();
/// Throws UsageError that begins with `option` if there is no such function.
void check_function(const std::string& option, const std::string& name);

/// Arguments with shapes and units.  Throws UsageError if the function has no such output or input.
Signature signature(const Request& request, const Setup& setup);

/// Lowerings that leave the function's results alone; the one that traces to the fewest operations
/// is taken.
std::vector<LoweringOptions> lowerings(const std::string& function);

/// rnea_hessian, frame_velocity_derivatives ... as derivatives; other requests as they are.
Request defined_as(const Request& request);

EngineFrames engine_frames(const Setup& setup);

}  // namespace arboc

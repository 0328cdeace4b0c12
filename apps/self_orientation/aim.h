// Angles of the steps that turn the body by a wanted heading.
#pragma once
#include <arboc/nlp/solver.hpp>

#include "afloat.h"

namespace self_orientation {

struct AimResult {
  bool found = false;
  std::string reason;
  Task task;       ///< with the angles found, and as many cycles as they need
  double heading;  ///< rad: reached
  int iterations = 0;
  double seconds = 0;
};

/// Of the free angles the least sum of squares, in units of their joints' ranges, that turns by
/// aim.heading / cycles and leaves the body upright; cycles: the fewest that can.
AimResult find_heading(const Model& model, const Task& task);

}  // namespace self_orientation

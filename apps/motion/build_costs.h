// The part of the objective that is quadratic in the curves.
#pragma once
#include "build.h"

namespace motion {

struct Shares {
  Free free;
  double of_time;  ///< of the phase, in that of all
};
/// Displacement, smoothness and the like, integrated exactly.
void add_regularity(arboc::nlp::Problem& problem, const Task& task, const Model& model,
                    const Phase& phase, const Shares& shares);

}  // namespace motion

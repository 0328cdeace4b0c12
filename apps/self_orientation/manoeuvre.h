// Steps -> joint angles over time.
#pragma once
#include <arboc/motion/point_to_point.hpp>

#include "models.h"
#include "task.h"

namespace self_orientation {

/// The joints' part of a motion.
class Manoeuvre {
 public:
  /// Throws std::invalid_argument where a joint is not there or an angle is out of its limits.
  Manoeuvre(const Task& task, const Model& model);

  double duration() const { return ends_.back(); }
  const std::vector<double>& ends() const { return ends_; }  ///< of the steps, s; 0 first
  arboc::MotionPath::Sample operator()(double t) const;
  /// In step `k` of ends(), also at its ends: accelerations are those of this step.
  arboc::MotionPath::Sample in_step(std::size_t k, double t) const { return paths_[k](t); }

 private:
  std::vector<arboc::MotionPath> paths_;
  std::vector<double> ends_{0};
};

}  // namespace self_orientation

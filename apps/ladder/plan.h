// Planning in two levels; [Astronaut] section 5.
//
// Global: the torso goes along the ladder by one motion under a limit of speed, and passes half way
// between the hands at the end of each period.  Periodic: one hand holds, the other goes to its
// next bar; joint angles at both ends by inverse kinematics, rates and accelerations there those of
// the torso's global motion with both hands at rest on their bars, quintics between.  A bump takes
// the moving hand around the bars that it passes.
#pragma once
#include <arboc/motion/point_to_point.hpp>
#include <vector>

#include "inverse.h"

namespace ladder {

struct Period {
  Hand held = kRight;
  int bar = 0;                                 ///< that is held
  int from = 0, to = 0;                        ///< bars of the other hand
  double begin = 0, end = 0;                   ///< s
  State first, last;                           ///< at its ends
  std::array<Joints, 6> powers{};              ///< q(s) = sum powers[k] s^k, s from 0 to 1
  Joints bump = Joints::Zero();                ///< times 64 s^3 (1 - s)^3
  std::vector<arboc::MotionFunction> stops{};  ///< from rest to rest instead: one a joint

  double duration() const { return end - begin; }
  State at(double t) const;
};

struct Plan {
  Task task;
  arboc::MotionFunction torso;  ///< its height, m; with stops each period's own
  std::vector<arboc::MotionFunction> torso_stops{};
  std::vector<Period> periods;
  double stretch = 1;  ///< of all times, so that joints keep their limit of speed

  double duration() const { return periods.back().end; }
  const Period& period(double t) const;
  arboc::MotionSample torso_height(double t) const;  ///< of the global level
};

/// Throws NoPosture, arboc::NoSuchMotion.
Plan plan(const Task& task);

/// Of a bar's place on a side of the body, m.
Vector3 grip(const Task& task, Hand hand, int bar);

}  // namespace ladder

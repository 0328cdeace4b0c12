// What a traverse comes to: hands on bars, the two levels of planning, torques, energy expenditure.
#pragma once
#include "closed_loop.h"
#include "common/animation.h"
#include "common/expenditure.h"
#include "plan.h"

namespace ladder {

struct Contact {
  double begin, end;
  Hand held;
  int bar, from, to;  ///< held; of the other hand
};

struct Result {
  std::vector<Contact> schedule;
  double hand_error = 0;      ///< m: of both hands from their bars at ends of periods
  double torso_mismatch = 0;  ///< m/s: of the levels at ends of periods, along the ladder
  double torso_mismatch_inside = 0;
  double reroot_error = 0;  ///< m, J: frames and kinetic energy of the two trees at a change
  double clearance = 0;  ///< m: least distance of a moving hand from bars that it passes; 0: none
  double limit_excess = 0;                ///< rad: beyond limits of joints, inside periods
  double joint_speed = 0;                 ///< rad/s: largest
  double stretch = 1;                     ///< of the task's duration
  double power_balance = 0;               ///< J: kinetic energy less work of the joints, largest
  double loop_error = 0, loop_speed = 0;  ///< both hands: of the left one
  study::Effort effort{0, 0};
  study::Rows q;            ///< frames x joints
  study::Rows hand_forces;  ///< frames x 6: of the bars on the right and on the left hand, N
  std::map<std::string, double> energy;
  std::vector<study::Peak> peaks;
  study::Animation animation;
  double seconds = 0;  ///< planning and evaluation, without pictures
};

Result traverse(const Task& task);
Result both_hands(const Task& task);

}  // namespace ladder

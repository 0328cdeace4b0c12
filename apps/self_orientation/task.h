// What is asked for: a body, its steps, and perhaps a heading to reach.  docs/astronaut.md
// describes the file.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace self_orientation {

/// From where the step before left the joints, from rest to rest by quintics ([Astronaut] (1)).
struct Step {
  std::string name;
  double duration = 1;              ///< s
  std::map<std::string, double> q;  ///< rad: where these joints end; others stay
  bool home = false;                ///< all joints back to the start instead
};

/// An angle of a step that may be chosen, in the range of its joint.
struct Free {
  std::string step, joint;
};

/// A heading to reach by choice of angles: least angles, upright again at the end.
struct Aim {
  bool wanted = false;
  double heading = 0;  ///< rad
  int most_cycles = 20;
  std::vector<Free> free;
};

struct Task {
  std::string name, model;
  std::map<std::string, double> start;  ///< rad: joints that do not start as the model does
  std::vector<Step> steps;
  int cycles = 1;
  double rate = 250;      ///< frames a second
  bool reverse = false;   ///< the steps run backwards in time
  double time_scale = 1;  ///< durations times this
  Aim aim;
};

/// Throws study::TaskError with file, line and column.
Task read_task(const std::string& path);

}  // namespace self_orientation

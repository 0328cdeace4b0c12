// A robot chosen by bytes, and one of many ways of writing it down as URDF.
#pragma once
#include <string>
#include <vector>

#include "fuzz/bytes.h"

namespace arboc::fuzz {

struct RobotJoint {
  std::string name, type;
  int parent = 0;  ///< index of a link; its child is link k + 1 of joint k
  double xyz[3] = {0, 0, 0}, rpy[3] = {0, 0, 0}, axis[3] = {1, 0, 0};
  int leader = -1;  ///< joint that it mimics
  double multiplier = 1, offset = 0;
};

struct Robot {
  std::string name;
  std::vector<std::string> links;  ///< the first one is the root
  std::vector<double> mass;        ///< a cube's inertia goes with it; 0: no <inertial>
  std::vector<RobotJoint> joints;
};

/// At most 6 joints.  Names are any text that a model may contain, and differ from each other.
Robot robot_of(Bytes& bytes);

/// Attribute order, quotes, white space, comments, escapes and the order of elements are chosen by
/// the bytes; what the text says is not.
std::string urdf_of(const Robot& robot, Bytes& bytes);

}  // namespace arboc::fuzz

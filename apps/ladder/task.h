// What is asked for: along a ladder hand over hand, or a motion with both hands on it.
// docs/astronaut.md describes the file.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ladder {

enum Hand { kRight = 0, kLeft = 1 };
const char* text(Hand hand);
inline Hand other(Hand hand) { return hand == kRight ? kLeft : kRight; }

/// Where the torso is in the sagittal plane: its shoulders from the mean of the hands, x away from
/// the bars (negative), z up; pitch about y, + forward.
struct Torso {
  double x = -0.5, z = -0.1, pitch = 0;  ///< m, rad
};

/// Both hands hold bars while the torso moves.
struct BothHands {
  std::array<int, 2> bars{0, 0};  ///< right, left
  Torso to;
};

/// Of hips and knees that nothing drives; about the angles of `legs`.
struct Passive {
  double stiffness = 0, damping = 0;  ///< N m/rad, N m s/rad
};

struct Task {
  std::string name;
  int bars = 9;            ///< the hands end on this one, from 0: one period more than bars
  double spacing = 0.3;    ///< m
  double duration = 12;    ///< s, of the whole
  Hand first = kLeft;      ///< the hand that moves first
  bool stops = false;      ///< the torso rests at the end of each period
  double rate = 200;       ///< frames a second
  double clearance = 0.1;  ///< m: how far the moving hand stays off bars that it passes
  Torso torso;
  double torso_speed = 1;              ///< m/s: limit
  double joint_speed = 6;              ///< rad/s: limit
  std::array<int, 2> elbows{1, 1};     ///< branch of right and left: 1 within limits, -1 the other
  std::map<std::string, double> legs;  ///< rad: hips and knees
  std::optional<Passive> floating;     ///< otherwise the legs are held
  std::optional<BothHands> both;
};

/// Throws study::TaskError with file, line and column.
Task read_task(const std::string& path);

}  // namespace ladder

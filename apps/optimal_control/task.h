// What is asked for: a motion of least torque between two states, in a given time.
// docs/astronaut.md describes the file.
#pragma once
#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace optimal_control {

enum class Method { kLagrangeNewton, kIpopt };

/// A point of a frame that is to be somewhere at the end, instead of angles that are given.
struct Reach {
  std::string frame;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< in the frame, m
  std::vector<std::optional<double>> place;         ///< x, y, z in the world, m; none: free
};

/// One period of a traverse as apps/ladder plans it: the ends are its states.
struct LadderPeriod {
  std::string task;  ///< file
  int period = 0;
};

struct Task {
  std::string name, model;              ///< of a ladder's period the model follows from the hand
  double duration = 1;                  ///< s
  std::map<std::string, double> start;  ///< rad; joints not named are at 0
  std::map<std::string, double> end;    ///< rad; of a reach only a guess
  std::optional<Reach> reach;
  std::optional<LadderPeriod> ladder;
  /// Of Int sum qdd^2 dt beside Int sum tau^2 dt, (N m s^2)^2: what joints that move no mass need.
  double smoothness = 0;
  bool smooth_ends = false;  ///< accelerations are zero at the ends, too
  int degree = 5, control_points = 12, points_per_span = 4;
  std::vector<Method> methods;
  bool limits = true;  ///< of angles and torques, where the method can
  double rate = 60;    ///< frames a second of what is written
  int max_iterations = 50;
};

/// Throws study::TaskError with file, line and column.
Task read_task(const std::string& path);
const char* text(Method method);

}  // namespace optimal_control

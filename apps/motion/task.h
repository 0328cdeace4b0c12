// What is asked for: a motion between two postures, as a task file says.  docs/motion_prediction.md
// describes the file.
#pragma once
#include <posture/task.h>

namespace motion {

using arboc::nlp::Vector3;

/// Where the motion begins or ends: a posture that is predicted, and how it moves there.
struct End {
  posture::Task posture{};
  bool has_objective = false;                ///< of its own; otherwise that of the motion
  std::map<std::string, double> velocity{};  ///< by coordinate, rad/s, m/s; others follow
  bool any_velocity = false;                 ///< whichever is best; of an end only

  bool at_rest() const;
};

/// A target at an instant.
struct Via {
  posture::Target target;
  double time = 0;  ///< s
};

/// Curves in time: B-splines.
struct Curves {
  int degree = 5;
  int control_points = 23;
  int reaction_points = 0;  ///< of reactions; 0: as many as of coordinates
};

/// Weights of means over time; those of [Thesis] (6.1)-(6.4) and of regularity.
struct Objective {
  double displacement = 0;            ///< of sum (q - relaxed)^2
  double torque = 0;                  ///< of sum tau^2
  double normalised = 0;              ///< of sum n^2, n = tau / limit
  double maximum = 0;                 ///< of the largest n over joints and time, exactly
  double smoothness = 2e-7;           ///< of sum (d^3 q / du^3)^2, u = t / duration
  double acceleration = 0;            ///< of sum (d^2 q / dt^2)^2
  double jerk = 0;                    ///< of sum (d^3 q / dt^3)^2
  double reactions = 1e-6;            ///< of sum (R / 100 N)^2
  double reaction_smoothness = 1e-9;  ///< of sum (d^3 R / du^3 / 100 N)^2
};

/// What the motion may miss between frames.
struct Tolerance {
  double force = 5, moment = 5;  ///< N, N m
  double drift = 1e-3;           ///< m
  double torque = 0.01;          ///< of the limit, beyond it
};

struct Search {
  int iterations = 500;
  double kkt = 1e-6;
  double seconds = 300;          ///< a solution
  int most_control_points = 43;  ///< refinement stops there
  int frames = 0;                ///< at equal distances; 0: at the Greville abscissae
  int between = 0;               ///< frames of torques only, between two others
  bool smooth_first = false;     ///< go to the objective from a motion that is smooth only
};

struct Task {
  std::string name, model;
  End start, end;
  double duration = 1;  ///< s
  std::vector<Via> vias{};
  Curves curves{};
  Objective objective{};
  Tolerance tolerance{};
  Search search{};
  std::vector<double> watched{};  ///< s: instants at which torques are looked at besides frames
};

/// Motions of which each begins in the state in which the one before ended.
struct Plan {
  std::string name;
  std::vector<Task> phases;  ///< at least one
};

/// Contacts of `next` that hold something and are not in `before`; those that only keep a point
/// above something, and push on nothing, hold nothing.
std::vector<std::string> new_contacts(const Task& before, const Task& next);

/// Throws study::TaskError with file, line and column.
Plan read_plan(const std::string& path);
/// Of a file without phases.
Task read_task(const std::string& path);

}  // namespace motion

// What is asked for: a posture of a robot, as a task file says.  docs/posture.md describes the
// file.
#pragma once
#include <arboc/nlp/stance.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace posture {

using arboc::nlp::Vector3;

struct Target {
  std::string name, frame;
  Vector3 point = Vector3::Zero();
  arboc::nlp::Place place{};
  std::vector<arboc::nlp::Alignment> align{};
};

/// An axis of a frame turned to a point or along a direction of the world.
struct Look {
  std::string name, frame;
  Vector3 eye = Vector3::Zero();  ///< in the frame
  Vector3 axis = Vector3::UnitX();
  std::optional<Vector3> at{};  ///< a point of the world; otherwise:
  Vector3 direction = Vector3::UnitZ();
  double weight = 0;               ///< of 1 - cos of the angle, in the objective
  std::optional<double> within{};  ///< rad: at most so far off
};

struct Sphere : arboc::nlp::Ball {
  std::string name{};
  std::string part{};  ///< spheres of one part do not collide
};

struct Collision {
  std::vector<Sphere> spheres{};
  std::vector<std::pair<std::string, std::string>> ignore{};  ///< parts that may overlap
  double margin = 0.1;  ///< m; pairs that are farther apart at a guess are left out at first
};

/// left = sign * right.
struct Mirror {
  std::string left, right;
  double sign = 1;
};

/// Weights of the parts of the objective; [Thesis] (5.1), (5.2), (5.6), (5.7).
struct Objective {
  double displacement = 0;  ///< of sum (q - relaxed)^2
  double torque = 0;        ///< of sum tau^2
  double normalised = 0;    ///< of sum n^2, n = tau / limit
  double norm = 0;          ///< of { sum (n^2 + 1)^p }^(1/p)
  double p = 100;
  double maximum = 0;       ///< of max n, exactly
  double reactions = 1e-6;  ///< of sum (R / 100 N)^2, which decides where nothing else does
};

struct Search {
  int starts = 10;  ///< the best one counts
  unsigned seed = 1;
  double spread = 1;  ///< of the ranges of joints in which starts lie, 0 to 1: all, about the guess
  bool random = false;  ///< the first one as well
  int restarts = 3;     ///< of a start that fails
  int iterations = 300;
};

struct Task {
  std::string name, model;
  std::string relaxed_posture{};            ///< of the model; empty: all coordinates at 0
  std::map<std::string, double> relaxed{};  ///< on top of it
  std::map<std::string, double> guess{};    ///< on top of that: where the first start begins
  std::vector<arboc::nlp::Contact> contacts{};
  std::vector<arboc::nlp::Load> loads{};
  std::vector<Target> targets{};
  std::vector<Look> looks{};
  Collision collision{};
  bool symmetric = false;
  double asymmetry =
      1e-3;  ///< rad, m: what symmetric postures may differ by, as bodies are not exactly so
  std::vector<Mirror> mirrors{};
  bool torque_limits = true;
  Objective objective{};
  Search search{};
};

/// Throws study::TaskError with file, line and column.
Task read_task(const std::string& path);

}  // namespace posture

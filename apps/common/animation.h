// A motion to look at: frames of bodies over time, sticks between their points, forces, and things
// that stand still.  gltf.h and page.h make files of it.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "csv.h"

namespace study {

/// A point of a body, in its frame, m.
struct BodyPoint {
  int body = 0;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
};

struct Stick {
  BodyPoint from, to;    ///< of one body, or of two
  double radius = 0.03;  ///< m
};

struct Force {
  std::string name;
  BodyPoint at;
  Rows newtons;  ///< frames x 3, along the axes of the world; on the body
};

/// Stands still: a bar of a ladder, a floor's edge.
struct Fixture {
  Eigen::Vector3d from, to;
  double radius = 0.02;
};

struct Animation {
  std::string name;
  std::vector<double> times;  ///< s, one a frame, rising
  std::vector<std::string> bodies;
  Rows placements;  ///< frames x 12 bodies: R by rows, p; as `fk` reports them
  std::vector<Stick> sticks;
  std::vector<Force> forces;
  std::vector<Fixture> fixtures;
  int up = 2;                      ///< axis of the world that points up on the screen
  double metre_per_newton = 2e-3;  ///< of arrows

  int frames() const { return static_cast<int>(times.size()); }
  int body(const std::string& name) const;  ///< throws std::invalid_argument
  /// Sticks from the origin of each of these bodies to that of the next.
  void add_limb(const std::vector<std::string>& limb, double radius = 0.03);
  Eigen::Vector3d point(int frame, const BodyPoint& p) const;  ///< in the world
};

/// A stick, arrow or fixture, wherever it is in each frame.
struct Segment {
  enum class Kind { kStick, kForce, kFixture };
  Kind kind;
  std::string name;
  double radius;
  Rows ends;  ///< frames x 6; of what stands still one row
};
/// Throws std::invalid_argument where sizes do not fit or times do not rise.
std::vector<Segment> segments(const Animation& animation);

}  // namespace study

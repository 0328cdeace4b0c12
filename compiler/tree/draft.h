// The dynamic tree while it is being lowered: rotations still as matrices, axes where they were.
//
// Each step of lower() reads and writes a Draft and keeps tau, M and the frames' placements.
#pragma once
#include <string>
#include <vector>

#include "tree/dynamic_tree.h"

namespace arboc {

/// E = R Rot(axis, q) and p = c + R (...) as in dynamic_tree.h, with `axis` in place of z.
struct DraftBody {
  Body body;                                        ///< gamma, alpha, theta not yet set
  Matrix3<double> R = Matrix3<double>::identity();  ///< of its frame in the parent's at q = 0
  Vector3<double> axis{0, 0, 1};                    ///< unit, in the body's frame
};

struct Draft {
  std::string name;
  int nq = 0;
  int nv = 0;
  Vector3<double> gravity;
  std::vector<DraftBody> body;  ///< body[0] is the world, parents before children
  std::vector<Frame> frame;
};

/// A new frame for a body: x_old = Q x_new + t.
struct Reframe {
  Matrix3<double> Q = Matrix3<double>::identity();
  Vector3<double> t;
};

/// Replaces the frame of every body.  Q must carry z to the joint's axis (or be the identity), and
/// t must lie on the axis; then no coordinate changes its meaning.  Linear in bodies and frames.
void reframe(Draft& draft, const std::vector<Reframe>& frames);

}  // namespace arboc

// The dynamic tree while it is being lowered: rotations still as matrices, axes where they were.
//
// Each step of lower() reads and writes a Draft and keeps tau, M and the frames' placements.
#pragma once
#include <string>
#include <vector>

#include "tree/mass_moments.h"

namespace arboc {

/// E = R Rot(axis, q) and p = c + R (...) as in dynamic_tree.h, with `axis` in place of z.
template <class S>
struct DraftBodyOf {
  BodyOf<S> body;                                   ///< gamma, alpha, theta not yet set
  Matrix3<double> R = Matrix3<double>::identity();  ///< of its frame in the parent's at q = 0
  Vector3<double> axis{0, 0, 1};                    ///< unit, in the body's frame
};
using DraftBody = DraftBodyOf<double>;

template <class S>
struct DraftOf {
  std::string name;
  int nq = 0;
  int nv = 0;
  Vector3<S> gravity;
  bool joint_forces = false;
  double friction_velocity = 0.01;
  std::vector<DraftBodyOf<S>> body;  ///< body[0] is the world, parents before children
  std::vector<FrameOf<S>> frame;
};
using Draft = DraftOf<double>;

/// A new frame for a body: x_old = Q x_new + t.
struct Reframe {
  Matrix3<double> Q = Matrix3<double>::identity();
  Vector3<double> t;
};

/// Replaces the frame of every body.  Q must carry z to the joint's axis (or be the identity), and
/// t must lie on the axis; then no coordinate changes its meaning.  Linear in bodies and frames.
template <class S>
void reframe(DraftOf<S>& draft, const std::vector<Reframe>& frames) {
  const auto relative = [](const Vector3<S>& a, const Vector3<double>& t) {
    return place(Matrix3<double>::identity(), a, cast<S>(-t));
  };
  for (size_t i = 1; i < draft.body.size(); ++i) {
    DraftBodyOf<S>& b = draft.body[i];
    const Reframe& own = frames[i];
    const Reframe& parent = frames[static_cast<size_t>(b.body.parent)];
    const Matrix3<double> down = transpose(parent.Q);
    const Vector3<S> c = place(b.R, cast<S>(own.t), b.body.c);
    b.body.c = place(down, relative(c, parent.t), Vector3<S>{});
    b.R = rotate(down, rotate(b.R, own.Q));
    b.axis = clean_unit(transpose(own.Q)) * b.axis;
    const Matrix3<double> Qt = transpose(own.Q);
    b.body.inertia = move(b.body.inertia, Qt, place(Qt, cast<S>(-own.t), Vector3<S>{}));
  }
  for (FrameOf<S>& frame : draft.frame) {
    const Reframe& body = frames[static_cast<size_t>(frame.body)];
    const Matrix3<double> Qt = transpose(body.Q);
    frame.p = place(Qt, relative(frame.p, body.t), Vector3<S>{});
    frame.R = rotate(Qt, frame.R);
  }
}

}  // namespace arboc

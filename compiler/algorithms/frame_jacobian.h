// Jacobians of frames and their time derivatives: q, v -> J and dJ/dt, where J v is the velocity of
// the frame in the given axes (frame_motion.h).
//
// A column is the twist of a joint's axis about the frame's (or the world's) origin.  Along the
// frame's own axes the chain is walked inward, so that only the rotation between joint and frame
// is formed.  Its derivative is the cross product with the velocity of the joint's body relative to
// the axes in which it is written: seen from the frame, minus what the joints between add.
// docs/theory.md section 7.
#pragma once
#include "algorithms/joint_jacobians.h"
#include "spatial/axes.h"

namespace arboc {

template <class T>
struct FrameJacobianWorkspace {
  Placements<T> placement;
  /// Of the bodies along world axes: about the world's origin, of kWorld; kAligned needs the
  /// angular part only.
  std::vector<Twist<T>> velocity;

  template <class Tree>
  explicit FrameJacobianWorkspace(const Tree& tree)
      : placement(tree), velocity(tree.body.size(), zero_twist<T>()) {}
};

/// Calls use(k, columns) for each body k from the frame's inward; the columns of its coordinates
/// are along the frame's axes, about its origin.
template <class Tree, class F, class T, class Use>
void for_each_local_column(const Tree& tree, const Poses<T>& pose, const F& frame, Use&& use) {
  Vector3<T> row[3];  // of the rotation, frame axes from body axes
  for (int i = 0; i < 3; ++i) row[i] = cast<T>(column(frame.R, i));
  Vector3<T> arm = turned(row, cast<T>(frame.p));  // from the body's origin to the frame's
  for (int k = frame.body; k != 0; k = tree.body[k].parent) {
    const auto& body = tree.body[k];
    Twist<T> columns[6];
    for (int d = 0; d < freedoms(body.motion); ++d) {
      const int c = component(body.motion, d);
      columns[d] = unit_twist(c, axis(row, c % 3), arm);
    }
    use(k, columns);
    if (body.parent == 0) break;
    for (Vector3<T>& r : row) r = up(body, pose[k], r);
    arm += turned(row, pose[k].p);
  }
}

/// The same along the world's axes, about a point.
template <class Tree, class F, class T, class Use>
void for_each_world_column(const Tree& tree, const Placements<T>& placement, const F& frame,
                           const Vector3<T>& point, Use&& use) {
  for (int k = frame.body; k != 0; k = tree.body[k].parent) {
    const auto& body = tree.body[k];
    Twist<T> columns[6];
    for (int d = 0; d < freedoms(body.motion); ++d) {
      const int c = component(body.motion, d);
      columns[d] = unit_twist(c, axis(placement[k].row, c % 3), point - placement[k].x);
    }
    use(k, columns);
  }
}

/// The point about which the columns of a frame are taken.
template <class F, class T>
Vector3<T> reference_point(const F& frame, const Placements<T>& placement, Axes axes) {
  if (axes == Axes::kWorld) return {T(0), T(0), T(0)};
  return frame_origin(frame, placement[frame.body]);
}

/// Calls use(k, columns) as above, in any axes.
template <class Tree, class F, class T, class Use>
void for_each_column(const Tree& tree, const Placements<T>& placement, const F& frame, Axes axes,
                     Use&& use) {
  if (axes == Axes::kLocal)
    for_each_local_column(tree, placement.pose, frame, use);
  else
    for_each_world_column(tree, placement, frame, reference_point(frame, placement, axes), use);
}

template <class Tree, class T>
void update_placements(const Tree& tree, Placements<T>& placement, const T* q, Axes axes) {
  if (axes == Axes::kLocal)
    placement.pose.update(tree, q);
  else
    placement.update(tree, q);
}

/// q (nq) -> J (6 x nv for each of `frames`, rows stacked, row-major).
template <class Tree, class T>
void frame_jacobian(const Tree& tree, FrameJacobianWorkspace<T>& work, const T* q,
                    const std::vector<int>& frames, Axes axes, T* J) {
  update_placements(tree, work.placement, q, axes);
  const int n = tree.nv;
  for (const int f : frames) {
    enter_block(q, tree.frame[f].name, "jacobian");
    fill_zero(J, 6 * n);
    for_each_column(tree, work.placement, tree.frame[f], axes,
                    [&](int k, const Twist<T>(&columns)[6]) {
                      const auto& body = tree.body[k];
                      for (int d = 0; d < freedoms(body.motion); ++d)
                        add_column(body.multiplier, columns[d], J + body.v + d, n);
                    });
    J += 6 * n;
  }
}

/// Velocities of the bodies along world axes.
template <class Tree, class T>
void world_velocities(const Tree& tree, FrameJacobianWorkspace<T>& work, const T* q, const T* v) {
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "velocity");
    work.velocity[k] = work.velocity[body.parent];
    for (int d = 0; d < freedoms(body.motion); ++d)
      work.velocity[k] += rate(body, v, d) * world_column(body, work.placement[k], d);
  }
}

/// The velocity of body k relative to the axes in which the frame's columns are written.  `inner`
/// is what the joints between body and frame add to the frame's.
template <class Tree, class T>
Twist<T> relative_velocity(const Tree& tree, const FrameJacobianWorkspace<T>& work, int k,
                           Axes axes, const Twist<T>& inner) {
  if (axes == Axes::kLocal) return {-inner.linear, -inner.angular};
  if (axes == Axes::kAligned) return {-inner.linear, work.velocity[k].angular};
  // A single axis does not change by its own motion.
  return work.velocity[freedoms(tree.body[k].motion) == 1 ? tree.body[k].parent : k];
}

/// q (nq), v (nv) -> the time derivative of J, of the same shape.
template <class Tree, class T>
void frame_jacobian_dot(const Tree& tree, FrameJacobianWorkspace<T>& work, const T* q, const T* v,
                        const std::vector<int>& frames, Axes axes, T* Jdot) {
  update_placements(tree, work.placement, q, axes);
  if (axes != Axes::kLocal) world_velocities(tree, work, q, v);
  const int n = tree.nv;
  for (const int f : frames) {
    enter_block(q, tree.frame[f].name, "jacobian");
    fill_zero(Jdot, 6 * n);
    Twist<T> inner = zero_twist<T>();
    for_each_column(
        tree, work.placement, tree.frame[f], axes, [&](int k, const Twist<T>(&columns)[6]) {
          const auto& body = tree.body[k];
          const Twist<T> relative = relative_velocity(tree, work, k, axes, inner);
          for (int d = 0; d < freedoms(body.motion); ++d) {
            add_column(body.multiplier, cross(relative, columns[d]), Jdot + body.v + d, n);
            inner += rate(body, v, d) * columns[d];
          }
        });
    Jdot += 6 * n;
  }
}

}  // namespace arboc

// External wrenches on frames: as wrenches on bodies, and how their share of tau changes with q.
//
// A wrench acts on the link; inverse dynamics subtracts it, tau = M a + nle - J^T wrench.  Along
// local axes it turns with the link; along the world's axes it keeps its direction.
#pragma once
#include "algorithms/placement.h"
#include "algorithms/twist.h"
#include "spatial/axes.h"

namespace arboc {

/// Force, then moment, per entry of `frames` (indices into tree.frame), as `axes` says.
template <class T>
struct FrameLoads {
  const std::vector<int>* frames = nullptr;
  Axes axes = Axes::kLocal;
  const T* wrench = nullptr;
};

/// E^T a through all joints from the world to body i.
template <class Tree, class T>
Vector3<T> from_world(const Tree& tree, const Poses<T>& pose, int i, const Vector3<T>& a) {
  if (i == 0) return a;
  std::vector<int> path;
  for (; i > 0; i = tree.body[i].parent) path.push_back(i);
  Vector3<T> b = a;
  for (size_t k = path.size(); k-- > 0;) b = down(tree.body[path[k]], pose[path[k]], b);
  return b;
}

/// The same of a wrench about the world's origin, which becomes one about the body's.
template <class Tree, class T>
Wrench<T> from_world(const Tree& tree, const Poses<T>& pose, int i, const Wrench<T>& a) {
  std::vector<int> path;
  for (; i > 0; i = tree.body[i].parent) path.push_back(i);
  Wrench<T> b = a;
  for (size_t k = path.size(); k-- > 0;) {
    const auto& body = tree.body[path[k]];
    const JointPose<T>& joint = pose[path[k]];
    b = {down(body, joint, b.f), down(body, joint, b.n - cross(joint.p, b.f))};
  }
  return b;
}

/// Load k about the origin of the body that carries its frame, in the body's axes.
template <class Tree, class T>
Wrench<T> load_on_body(const Tree& tree, const Poses<T>& pose, const FrameLoads<T>& loads,
                       size_t k) {
  const T* w = loads.wrench + 6 * k;
  const Wrench<T> given{{w[0], w[1], w[2]}, {w[3], w[4], w[5]}};
  const auto& frame = tree.frame[(*loads.frames)[k]];
  const Vector3<T> p = cast<T>(frame.p);
  switch (loads.axes) {
    case Axes::kWorld: return from_world(tree, pose, frame.body, given);
    case Axes::kAligned: {
      const Vector3<T> f = from_world(tree, pose, frame.body, given.f);
      return {f, from_world(tree, pose, frame.body, given.n) + cross(p, f)};
    }
    default: {
      const Matrix3<T> R = cast<T>(frame.R);
      const Vector3<T> f = R * given.f;
      return {f, R * given.n + cross(p, f)};
    }
  }
}

/// Takes the loads from the wrenches that the bodies need.
template <class Tree, class T>
ARBOC_COLD void subtract_loads(const Tree& tree, const Poses<T>& pose, const FrameLoads<T>& loads,
                               std::vector<Wrench<T>>& wrench) {
  for (size_t k = 0; k < loads.frames->size(); ++k) {
    const Wrench<T> load = load_on_body(tree, pose, loads, k);
    Wrench<T>& on = wrench[tree.frame[(*loads.frames)[k]].body];
    on.f = on.f - load.f;
    on.n = on.n - load.n;
  }
}

/// A coordinate between a frame and the world, and what it moves there along world axes.
template <class T>
struct LoadedColumn {
  int body = 0;
  int coordinate = 0;
  double multiplier = 1;
  Twist<T> twist;
};

/// Those of the path from body i to the world, lowest first; linear parts of the point at `x`.
template <class Tree, class T>
std::vector<LoadedColumn<T>> loaded_columns(const Tree& tree, const Placements<T>& placement, int i,
                                            const Vector3<T>& x) {
  std::vector<LoadedColumn<T>> columns;
  for (; i > 0; i = tree.body[i].parent) {
    const auto& body = tree.body[i];
    const BodyPlacement<T>& at = placement[i];
    for (int d = 0; d < freedoms(body.motion); ++d) {
      const int c = component(body.motion, d);
      columns.push_back(
          {i, body.v + d, body.multiplier, unit_twist(c, axis(at.row, c % 3), x - at.x)});
    }
  }
  return columns;
}

/// Adds d(-J^T wrench)/dq of loads along world axes; of local ones the wrenches that turn with the
/// bodies contain it.  With columns s = (w, l) and j above i or on its joint
///   world    ds_i/dq_j = s_j x s_i,              ds_j/dq_i = 0
///   aligned  d(l_i + w_i x x)/dq_j = w_j x (l_i + w_i x x) = d(l_j + w_j x x)/dq_i.
template <class Tree, class T, class Square>
ARBOC_COLD void add_load_derivatives(const Tree& tree, Placements<T>& placement, const T* q,
                                     const FrameLoads<T>& loads, Square& dtau_dq) {
  if (loads.axes == Axes::kLocal) return;
  placement.update(tree, q);
  const bool aligned = loads.axes == Axes::kAligned;
  const Vector3<T> origin{T(0), T(0), T(0)};
  for (size_t k = 0; k < loads.frames->size(); ++k) {
    const auto& frame = tree.frame[(*loads.frames)[k]];
    const T* w = loads.wrench + 6 * k;
    const Vector3<T> f{w[0], w[1], w[2]}, n{w[3], w[4], w[5]};
    const auto columns = loaded_columns(
        tree, placement, frame.body, aligned ? frame_origin(frame, placement[frame.body]) : origin);
    const auto add = [&](const LoadedColumn<T>& i, const LoadedColumn<T>& j, const T& power) {
      T& entry = dtau_dq(i.coordinate, j.coordinate);
      entry = entry - (i.multiplier * j.multiplier) * power;
    };
    for (const LoadedColumn<T>& i : columns) {
      for (const LoadedColumn<T>& j : columns) {
        if (j.body > i.body) continue;
        const T turning = dot(cross(j.twist.angular, i.twist.angular), n);
        if (!aligned) {
          add(i, j, dot(cross(j.twist, i.twist).linear, f) + turning);
          continue;
        }
        const T sweeping = dot(cross(j.twist.angular, i.twist.linear), f);
        add(i, j, sweeping + turning);
        if (j.body < i.body) add(j, i, sweeping);
      }
    }
  }
}

}  // namespace arboc

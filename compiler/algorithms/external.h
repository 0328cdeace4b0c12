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

/// The loads on a body and on what it carries, along world axes.
template <class T>
struct CarriedLoads {
  bool any = false;
  Wrench<T> sum;  ///< forces and moments as they are given, not brought to one point
  /// Per coordinate of its joint the sum of l x f, l the linear part of the coordinate's twist.
  Vector3<T> sweep[6];
};

/// Those of all bodies; l is taken where the loads are given.
template <class Tree, class T>
std::vector<CarriedLoads<T>> carried_loads(const Tree& tree, const Placements<T>& placement,
                                           const FrameLoads<T>& loads) {
  const Vector3<T> zero{T(0), T(0), T(0)};
  CarriedLoads<T> none{false, {zero, zero}, {zero, zero, zero, zero, zero, zero}};
  std::vector<CarriedLoads<T>> carried(tree.body.size(), none);
  for (size_t k = 0; k < loads.frames->size(); ++k) {
    const auto& frame = tree.frame[(*loads.frames)[k]];
    const T* w = loads.wrench + 6 * k;
    const Vector3<T> f{w[0], w[1], w[2]}, n{w[3], w[4], w[5]};
    const bool aligned = loads.axes == Axes::kAligned;
    const Vector3<T> point = aligned ? frame_origin(frame, placement[frame.body]) : zero;
    for (int i = frame.body; i > 0; i = tree.body[i].parent) {
      const auto& body = tree.body[i];
      CarriedLoads<T>& own = carried[i];
      own.any = true;
      own.sum.f += f;
      own.sum.n += n;
      for (int d = 0; d < freedoms(body.motion); ++d) {
        const int c = component(body.motion, d);
        const Vector3<T> a = axis(placement[i].row, c % 3);
        own.sweep[d] += cross(unit_twist(c, a, point - placement[i].x).linear, f);
      }
    }
  }
  return carried;
}

/// Adds d(-J^T wrench)/dq of loads along world axes; of local ones the wrenches that turn with the
/// bodies contain it.  With columns s = (l, w), j above i or on its joint, sums over the loads that
/// i carries
///   world    d tau_i/dq_j = -w_j . (sum l_i x f + w_i x sum n) - l_j . (w_i x sum f)
///   aligned  d tau_i/dq_j = -w_j . (sum l_i x f + w_i x sum n),  d tau_j/dq_i = -w_j . sum l_i x f
/// so that a pair of coordinates costs the same however many loads there are.  What is zero where
/// two axes are parallel would not cancel in the graph, so it is left out.
template <class Tree, class T, class Square>
struct LoadDerivatives {
  const Tree& tree;
  const Placements<T>& placement;
  Square& dtau_dq;
  bool aligned;

  /// Coordinate d of body i with all above.
  void add(int i, int d, const CarriedLoads<T>& carried) const {
    const auto& body = tree.body[i];
    const int c = component(body.motion, d);
    const Vector3<T> zero{T(0), T(0), T(0)};
    const Vector3<T> a = axis(placement[i].row, c % 3), w = c < 3 ? zero : a;
    const Vector3<T>& sweep = carried.sweep[d];
    const Vector3<T> turn = sweep + cross(w, carried.sum.n), f = cross(w, carried.sum.f);
    for (int j = i; j > 0; j = tree.body[j].parent) {
      const auto& above = tree.body[j];
      for (int e = 0; e < freedoms(above.motion); ++e) {
        const int g = component(above.motion, e);
        const Vector3<T> b = axis(placement[j].row, g % 3);
        const bool parallel = coincide(a.x, b.x) && coincide(a.y, b.y) && coincide(a.z, b.z);
        const bool still = g < 3 || (c < 3 && parallel);
        const double factor = body.multiplier * above.multiplier;
        const T swept = still ? T(0) : dot(b, parallel ? sweep : turn);
        if (aligned) {
          subtract(factor * swept, body.v + d, above.v + e);
          if (j < i && !still) subtract(factor * dot(b, sweep), above.v + e, body.v + d);
        } else if (!parallel || (g >= 3 && i != j)) {
          const Vector3<T> l = unit_twist(g, b, -placement[j].x).linear;
          subtract(factor * (swept + dot(l, f)), body.v + d, above.v + e);
        }
      }
    }
  }

 private:
  void subtract(const T& power, int row, int col) const {
    T& entry = dtau_dq(row, col);
    entry = entry - power;
  }
};

template <class Tree, class T, class Square>
ARBOC_COLD void add_load_derivatives(const Tree& tree, Placements<T>& placement, const T* q,
                                     const FrameLoads<T>& loads, Square& dtau_dq) {
  if (loads.axes == Axes::kLocal) return;
  placement.update(tree, q);
  const std::vector<CarriedLoads<T>> carried = carried_loads(tree, placement, loads);
  const LoadDerivatives<Tree, T, Square> derivatives{tree, placement, dtau_dq,
                                                     loads.axes == Axes::kAligned};
  for (int i = tree.nb(); i > 0; --i) {
    if (!carried[i].any) continue;
    enter_block(q, tree.body[i].link, "loads");
    for (int d = 0; d < freedoms(tree.body[i].motion); ++d) derivatives.add(i, d, carried[i]);
  }
}

}  // namespace arboc

// Statics: q, loads -> the joint forces that hold the body at rest under gravity, the joints' own
// forces and loads.
//
// Wrenches are summed along the world's axes, about the origin of each body in turn: no vector is
// rotated on the way up, and what is below a body enters as its mass, first moment and load.
//   weight: f = -m g, n = -s x g,   s = R h of the body and those that it carries
// Moves of a free base leave all moments alone, which the graph then shows.
#pragma once
#include "algorithms/external.h"
#include "algorithms/joint_forces.h"
#include "algorithms/twist.h"

namespace arboc {

template <class T>
struct StaticsWorkspace {
  struct Link {
    T m{};           ///< kg, of the subtree
    Vector3<T> s;    ///< kg m, of the subtree, about the body's origin, world axes
    Wrench<T> load;  ///< on the subtree, about the body's origin, world axes
  };
  Placements<T> placement;
  std::vector<Link> link;

  template <class Tree>
  explicit StaticsWorkspace(const Tree& tree) : placement(tree), link(tree.body.size()) {}
};

/// A load about the origin of the body that carries its frame, along the world's axes.
template <class Tree, class T>
Wrench<T> load_in_world(const Tree& tree, const Placements<T>& placement,
                        const FrameLoads<T>& loads, size_t k) {
  const T* w = loads.wrench + 6 * k;
  const Wrench<T> given{{w[0], w[1], w[2]}, {w[3], w[4], w[5]}};
  const auto& frame = tree.frame[(*loads.frames)[k]];
  const BodyPlacement<T>& at = placement[frame.body];
  if (loads.axes == Axes::kWorld) return {given.f, given.n - cross(at.x, given.f)};
  const Vector3<T> arm = turned(at.row, cast<T>(frame.p));
  if (loads.axes == Axes::kAligned) return {given.f, given.n + cross(arm, given.f)};
  const Matrix3<T> R = cast<T>(frame.R);
  const Vector3<T> f = turned(at.row, R * given.f);
  return {f, turned(at.row, R * given.n) + cross(arm, f)};
}

/// q (nq) -> tau (nv).
template <class Tree, class T>
void statics(const Tree& tree, StaticsWorkspace<T>& work, const T* q, T* tau,
             const FrameLoads<T>* loads = nullptr) {
  work.placement.update(tree, q);
  const Vector3<T> zero{T(0), T(0), T(0)}, g = cast<T>(tree.gravity);
  for (int i = 1; i <= tree.nb(); ++i) {
    const auto& body = tree.body[i];
    enter_block(q, body.link, "weight");
    work.link[i] = {
        T(body.inertia.m), turned(work.placement[i].row, cast<T>(body.inertia.h)), {zero, zero}};
  }
  for (size_t k = 0; loads && k < loads->frames->size(); ++k) {
    const int i = tree.frame[(*loads->frames)[k]].body;
    if (i == 0) continue;
    const Wrench<T> load = load_in_world(tree, work.placement, *loads, k);
    work.link[i].load.f += load.f;
    work.link[i].load.n += load.n;
  }
  for (int k = 0; k < tree.nv; ++k) tau[k] = T(0);
  for (int i = tree.nb(); i > 0; --i) {
    const auto& body = tree.body[i];
    enter_block(q, body.link, "force");
    const auto& link = work.link[i];
    const Vector3<T> f = -(link.m * g) - link.load.f, n = -cross(link.s, g) - link.load.n;
    for (int d = 0; d < freedoms(body.motion); ++d) {
      const int c = component(body.motion, d);
      T& entry = tau[body.v + d];
      entry = entry + body.multiplier * dot(axis(work.placement[i].row, c % 3), c < 3 ? f : n);
    }
    if (body.parent == 0) continue;
    auto& parent = work.link[body.parent];
    const Vector3<T> arm = turned(work.placement[body.parent].row, work.placement.pose[i].p);
    parent.m = parent.m + link.m;
    parent.s += link.s + link.m * arm;
    parent.load.f += link.load.f;
    parent.load.n += link.load.n + cross(arm, link.load.f);
  }
  add_springs(tree, q, tau);
}

}  // namespace arboc

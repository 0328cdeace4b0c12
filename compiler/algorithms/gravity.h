// Gravity forces: q -> g(q), the joint forces that hold the body at rest.
//
// All links accelerate by -g, so the wrench on a subtree is m dv and h x dv with its composite mass
// and first moment about the joint's origin: one vector goes down and one comes up.
#pragma once
#include "algorithms/link_motion.h"
#include "algorithms/wrench.h"

namespace arboc {

template <class T>
struct GravityWorkspace {
  struct Link {
    Vector3<T> dv;  ///< -g in the body's axes, m/s^2
    T m{};          ///< kg, of the subtree
    Vector3<T> h;   ///< kg m, of the subtree
  };
  Poses<T> pose;
  std::vector<Link> link;

  template <class Tree>
  explicit GravityWorkspace(const Tree& tree) : pose(tree), link(tree.body.size()) {
    link[0].dv = world_acceleration<T>(tree);
  }
};

/// q (nq) -> g (nv).
template <class Tree, class T>
void gravity(const Tree& tree, GravityWorkspace<T>& work, const T* q, T* g) {
  work.pose.update(tree, q);
  for (int i = 1; i <= tree.nb(); ++i) {
    const auto& body = tree.body[i];
    enter_block(q, body.link, "motion");
    auto& link = work.link[i];
    link.dv = down(body, work.pose[i], work.link[body.parent].dv);
    link.m = T(body.inertia.m);
    link.h = cast<T>(body.inertia.h);
  }
  for (int k = 0; k < tree.nv; ++k) g[k] = T(0);
  for (int i = tree.nb(); i > 0; --i) {
    const auto& body = tree.body[i];
    enter_block(q, body.link, "force");
    const auto& link = work.link[i];
    add_joint_force(body, Wrench<T>{link.m * link.dv, cross(link.h, link.dv)}, g);
    if (body.parent == 0) continue;
    auto& parent = work.link[body.parent];
    parent.m = parent.m + limb_sum(body, link.m);
    parent.h += limb_sum(body, up(body, work.pose[i], link.h) + link.m * work.pose[i].p);
  }
}

}  // namespace arboc

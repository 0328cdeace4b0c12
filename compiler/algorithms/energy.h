// Kinetic and potential energy: q, v -> T, V.
//
// Velocities go outward along the bodies' axes; of each body
//   T = l . (m l / 2 + w x h) + w . J w,   2 J = tr(Sigma) 1 - Sigma,
// and the first moment of all comes inward for V = -g . h.
#pragma once
#include "algorithms/com.h"
#include "algorithms/frame_motion.h"

namespace arboc {

template <class T>
struct EnergyWorkspace {
  Poses<T> pose;
  std::vector<PointMotion<T>> motion;
  std::vector<FirstMoments<T>> moments;

  template <class Tree>
  explicit EnergyWorkspace(const Tree& tree)
      : pose(tree),
        motion(tree.body.size(), PointMotion<T>{zero_twist<T>(), zero_twist<T>()}),
        moments(tree.body.size()) {}
};

/// Of a body that moves with `velocity`, spatial along its axes.
template <class I, class T>
T kinetic_energy(const I& inertia, const Twist<T>& velocity) {
  const Vector3<T>&l = velocity.linear, &w = velocity.angular;
  const auto& S = inertia.Sigma;
  const T half(0.5);
  const T xx = half * (T(S.yy) + T(S.zz)), yy = half * (T(S.xx) + T(S.zz)),
          zz = half * (T(S.xx) + T(S.yy));
  const T turning = w.x * (xx * w.x - T(S.xy) * w.y - T(S.xz) * w.z) +
                    w.y * (yy * w.y - T(S.yz) * w.z) + w.z * (zz * w.z);
  return turning + dot(l, (half * T(inertia.m)) * l + cross(w, cast<T>(inertia.h)));
}

/// q (nq), v (nv) -> kinetic and potential energy (J) of the moving bodies; the potential is 0
/// where all centres of mass are at the world's origin.
template <class Tree, class T>
void energy(const Tree& tree, EnergyWorkspace<T>& work, const T* q, const T* v, T* kinetic,
            T* potential) {
  work.pose.update(tree, q);
  T sum(0);
  for (int k = 1; k <= tree.nb(); ++k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "motion");
    work.motion[k] = local_motion<false>(body, work.pose[k], work.motion[body.parent], v,
                                         static_cast<const T*>(nullptr));
    sum = sum + kinetic_energy(body.inertia, work.motion[k].v);
  }
  *kinetic = sum;

  const Vector3<T> zero{T(0), T(0), T(0)};
  work.moments[0] = {T(0), zero, zero};
  for (int k = 1; k <= tree.nb(); ++k)
    work.moments[k] = {T(tree.body[k].inertia.m), cast<T>(tree.body[k].inertia.h), zero};
  for (int k = tree.nb(); k > 0; --k) {
    const auto& body = tree.body[k];
    enter_block(q, body.link, "first moment");
    add_first_moments(body, work.pose[k], work.moments[k], work.moments[body.parent]);
  }
  *potential = -dot(cast<T>(tree.gravity), work.moments[0].h);
}

}  // namespace arboc

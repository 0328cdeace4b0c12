// First derivatives of inverse dynamics: q, v, a -> dtau/dq, dtau/dv, dtau/da = M.
//
// One pass over the pairs (joint, ancestor), docs/theory.md section 5.  Of each pair
//   rows of the ancestor     come from wrenches on the subtree, carried up as in crba;
//   columns of the ancestor  come from the third of these, M's, and one vector b carried with it.
// Seen from the non-rotating frame that moves with a body's origin, points of its subtree have
// velocities r'; P = integral of r' dm and K = integral of r' r^T dm are all that enters of them.
// They occur doubled only, so 2 P, 2 K and 2 b are what is formed, from 2 w.
#pragma once
#include "algorithms/crba.h"
#include "algorithms/perturbation.h"
#include "algorithms/rnea.h"

namespace arboc {

/// Dense row-major matrix.
template <class T>
struct SquareMatrix {
  T* data = nullptr;
  int n = 0;
  T& operator()(int i, int j) const { return data[i * n + j]; }
};

/// 2 P and 2 K of a subtree.
template <class T>
struct VelocityMoments {
  Vector3<T> P;
  Matrix3<T> K;
};

template <class T>
struct RneaDerivativesWorkspace {
  RneaWorkspace<T> rnea;
  Placements<T> placement;  ///< for loads along world axes
  std::vector<Composite<T>> composite;
  std::vector<VelocityMoments<T>> moments;
  std::vector<Vector3<T>> drift;  ///< twice the origin's velocity relative to the parent's, there
  std::vector<CoordinatePerturbation<T>> perturbation;  ///< six a body

  template <class Tree>
  explicit RneaDerivativesWorkspace(const Tree& tree)
      : rnea(tree),
        placement(tree),
        composite(tree.body.size()),
        moments(tree.body.size()),
        drift(tree.body.size()),
        perturbation(6 * tree.body.size()) {}
};

/// Those of a body alone: P = w x h, K = [w] Sigma.
template <class S, class T>
VelocityMoments<T> velocity_moments(const MassMomentsOf<S>& inertia, const Vector3<T>& w) {
  const Vector3<T> w2 = T(2) * w;
  const Symmetric3<T> I = cast<T>(inertia.Sigma);
  const Vector3<T> x = cross(w2, Vector3<T>{I.xx, I.xy, I.xz});
  const Vector3<T> y = cross(w2, Vector3<T>{I.xy, I.yy, I.yz});
  const Vector3<T> z = cross(w2, Vector3<T>{I.xz, I.yz, I.zz});
  return {cross(w2, cast<T>(inertia.h)), {{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}}};
}

/// Adds those of a subtree to its parent's: with d = drift, h' = E h, s = E P + m d
///   P += s,   K += E K E^T + s p^T + d h'^T.
template <class S, class T>
void add_velocity_moments(const BodyOf<S>& body, const JointPose<T>& pose, const Composite<T>& C,
                          const Vector3<T>& drift, const VelocityMoments<T>& own,
                          VelocityMoments<T>& parent) {
  const Vector3<T> h = up(body, pose, C.h);
  const Vector3<T> s = up(body, pose, own.P) + C.m * drift;
  const Matrix3<T> K = up(body, pose, own.K);
  parent.P += limb_sum(body, s);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      parent.K(i, j) =
          parent.K(i, j) + limb_sum(body, K(i, j) + (s[i] * pose.p[j] + drift[i] * h[j]));
}

/// tr(K) a - K a.
template <class T>
Vector3<T> complement(const Matrix3<T>& K, const Vector3<T>& a) {
  return {(K(1, 1) + K(2, 2)) * a.x - (K(0, 1) * a.y + K(0, 2) * a.z),
          (K(0, 0) + K(2, 2)) * a.y - (K(1, 0) * a.x + K(1, 2) * a.z),
          (K(0, 0) + K(1, 1)) * a.z - (K(2, 0) * a.x + K(2, 1) * a.y)};
}

/// What must act on the subtree in addition.
template <class T>
Wrench<T> perturbed_wrench(const Composite<T>& C, const VelocityMoments<T>& L,
                           const Perturbation<T>& x) {
  return {C.m * x.linear + (cross(x.angular, C.h) + cross(x.rate, L.P)),
          complement(full(C.Sigma), x.angular) + (cross(C.h, x.linear) + complement(L.K, x.rate))};
}

/// Column of a coordinate on its way from its joint to the root, along the axes of some ancestor.
template <class T>
struct DerivativeColumn {
  Wrench<T> q, v, a;  ///< changes of what acts on the subtree
  Vector3<T> b;       ///< twice the integral of r' x s, where s moves along with the coordinate
};

template <class T>
DerivativeColumn<T> derivative_column(const Composite<T>& C, const VelocityMoments<T>& L,
                                      const CoordinatePerturbation<T>& x, int component) {
  const Vector3<T> e = unit_vector<T>(component % 3);
  return {perturbed_wrench(C, L, x.q), perturbed_wrench(C, L, x.v), unit_wrench(C, component),
          component < 3 ? cross(L.P, e) : complement(transpose(L.K), e)};
}

/// A wrench F seen from the parent changes with the body's axes and origin too.
template <class T>
void turn_with_body(const Wrench<T>& F, int component, Wrench<T>& wrench) {
  const Vector3<T> e = unit_vector<T>(component % 3);
  if (component < 3) {
    wrench.n += cross(e, F.f);
  } else {
    wrench.f += cross(e, F.f);
    wrench.n += cross(e, F.n);
  }
}

/// Carries the column from body k to its parent.
template <class S, class T>
void carry(const BodyOf<S>& body, const JointPose<T>& pose, const Vector3<T>& drift,
           DerivativeColumn<T>& column) {
  column.q = up(body, pose, column.q);
  column.v = up(body, pose, column.v);
  column.a = up(body, pose, column.a);
  column.b = up(body, pose, column.b) + cross(drift, column.a.f);
}

/// The three results while they are summed.  Mimic joints: G^T X G, so every pair of bodies adds
/// to the entries of their coordinates.
template <class Square, class Upper>
struct RneaDerivativesOutput {
  Square& dq;
  Square& dv;
  Upper& M;

  /// Entries (coordinates of `row`, coordinate d of `body`).
  template <class T>
  void add_rows(const Body& row, const Body& body, int d, const DerivativeColumn<T>& column) {
    const auto add = [&](Square& matrix, const Wrench<T>& wrench) {
      for_each_joint_force(row.motion, wrench, [&](int e, const T& force) {
        T& entry = matrix(row.v + e, body.v + d);
        entry = entry + row.multiplier * body.multiplier * force;
      });
    };
    add(dq, column.q);
    add(dv, column.v);
    add_entries(row, body, d, column.a, M);
  }
  /// Entries (coordinate d of `body`, coordinates of its ancestor).
  template <class T>
  void add_columns(const Body& ancestor, const CoordinatePerturbation<T>* x, const Body& body,
                   int d, const DerivativeColumn<T>& column) {
    const auto add = [&](T& entry, const Perturbation<T>& p) {
      const T force =
          (dot(column.a.f, p.linear) + dot(column.a.n, p.angular)) + dot(column.b, p.rate);
      entry = entry + ancestor.multiplier * body.multiplier * force;
    };
    for (int e = 0; e < freedoms(ancestor.motion); ++e) {
      add(dq(body.v + d, ancestor.v + e), x[e].q);
      add(dv(body.v + d, ancestor.v + e), x[e].v);
    }
  }
};

/// Motion, wrenches and moments of each body alone.
template <class Tree, class T>
void derivative_sweep_out(const Tree& tree, RneaDerivativesWorkspace<T>& work, const T* q,
                          const T* v, const T* a) {
  const Poses<T>& pose = work.rnea.pose;
  for (int i = 1; i <= tree.nb(); ++i) {
    const auto& body = tree.body[i];
    enter_block(q, body.link, "motion");
    const LinkMotion<T>& parent = work.rnea.motion[body.parent];
    LinkMotion<T>& motion = work.rnea.motion[i];
    advance<true>(body, pose[i], parent, v, a, motion);
    work.rnea.wrench[i] = inertial_wrench(body.inertia, motion, work.rnea.needed[i]);
    work.composite[i] = own_composite<T>(body.inertia);
    work.moments[i] = velocity_moments(body.inertia, motion.w);
    perturb(body, pose[i], parent, motion, v, &work.perturbation[6 * i]);
    work.drift[i] =
        cross(T(2) * parent.w, pose[i].p) + up(body, pose[i], T(2) * joint_velocity(body, v));
  }
}

/// Adds the subtree of body j to its parent's.
template <class S, class T>
void add_subtree(const BodyOf<S>& body, int j, RneaDerivativesWorkspace<T>& work) {
  const JointPose<T>& pose = work.rnea.pose[j];
  const int p = body.parent;
  const Wrench<T> carried = limb_sum(body, up(body, pose, work.rnea.wrench[j]));
  work.rnea.wrench[p].f += carried.f;
  work.rnea.wrench[p].n += carried.n;
  add_velocity_moments(body, pose, work.composite[j], work.drift[j], work.moments[j],
                       work.moments[p]);
  add_composite(body, pose, work.composite[j], work.composite[p]);
}

/// q (nq), v, a (nv) -> dtau_dq, dtau_dv (i, j) and (j, i), M (i, j) for j and i in
/// tree.coupled[j]; no other entry is touched.  Of M only the upper triangle is.
template <class Tree, class T, class Square, class Upper>
void rnea_derivatives(const Tree& tree, RneaDerivativesWorkspace<T>& work, const T* q, const T* v,
                      const T* a, Square&& dtau_dq, Square&& dtau_dv, Upper&& M,
                      const FrameLoads<T>* loads = nullptr) {
  work.rnea.pose.update(tree, q);
  derivative_sweep_out(tree, work, q, v, a);
  if (loads && loads->axes == Axes::kLocal)
    subtract_loads(tree, work.rnea.pose, *loads, work.rnea.wrench);
  for (int j = 0; j < tree.nv; ++j) {
    dtau_dq(j, j) = dtau_dv(j, j) = M(j, j) = T(0);
    for (const int i : tree.coupled[j]) {
      dtau_dq(i, j) = dtau_dv(i, j) = M(i, j) = T(0);
      dtau_dq(j, i) = dtau_dv(j, i) = T(0);
    }
  }
  RneaDerivativesOutput<Square, Upper> out{dtau_dq, dtau_dv, M};
  for (int j = tree.nb(); j > 0; --j) {
    const auto& body = tree.body[j];
    enter_block(q, body.link, "column");
    for (int d = 0; d < freedoms(body.motion); ++d) {
      const int c = component(body.motion, d);
      DerivativeColumn<T> column =
          derivative_column(work.composite[j], work.moments[j], work.perturbation[6 * j + d], c);
      out.add_rows(body, body, d, column);
      turn_with_body(work.rnea.wrench[j], c, column.q);
      next_step(q);
      for (int k = j; tree.body[k].parent != 0;) {
        carry(tree.body[k], work.rnea.pose[k], work.drift[k], column);
        k = tree.body[k].parent;
        out.add_rows(tree.body[k], body, d, column);
        out.add_columns(tree.body[k], &work.perturbation[6 * k], body, d, column);
        next_step(q);
      }
    }
    if (body.parent == 0) continue;
    enter_block(q, body.link, "composite");
    add_subtree(body, j, work);
  }
  add_joint_force_derivatives(tree, v, dtau_dq, dtau_dv);
  add_rotors(tree, M);
  if (loads) add_load_derivatives(tree, work.placement, q, *loads, dtau_dq);
}

}  // namespace arboc

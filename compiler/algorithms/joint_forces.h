// What joints add by themselves: damping, friction, springs, rotors (JointForcesOf).
//
// Friction is smooth, f r / sqrt(r^2 + s^2): forward dynamics and its derivatives stay exact where
// the rate changes sign.
#pragma once
#include <cmath>

#include "algorithms/joint.h"

namespace arboc {

/// Friction of rate r, and its derivative.
template <class T>
T friction_force(const T& friction, const T& r, double s) {
  using std::sqrt;
  return friction * r / sqrt(r * r + T(s * s));
}
template <class T>
T friction_slope(const T& friction, const T& r, double s) {
  using std::sqrt;
  const T square = r * r + T(s * s);
  return friction * T(s * s) / (square * sqrt(square));
}

/// Adds them to tau (nv); without accelerations `a` is not read.
template <bool kAccelerated, class Tree, class T>
ARBOC_COLD void add_joint_forces(const Tree& tree, const T* q, const T* v, const T* a, T* tau) {
  if (!tree.joint_forces) return;
  for (const auto& body : tree.body) {
    const auto& f = body.forces;
    for (int d = 0; d < freedoms(body.motion); ++d) {
      T force(0);
      const T r = rate(body, v, d);
      if (!vanishes(f.damping)) force = force + T(f.damping) * r;
      if (!vanishes(f.friction))
        force = force + friction_force(T(f.friction), r, tree.friction_velocity);
      if (!vanishes(f.stiffness) && freedoms(body.motion) == 1)
        force = force + T(f.stiffness) * (coordinate(body, q) - T(f.neutral));
      if constexpr (kAccelerated)
        if (!vanishes(f.rotor)) force = force + T(f.rotor) * rate(body, a, d);
      T& entry = tau[body.v + d];
      entry = entry + body.multiplier * force;
    }
  }
}

/// Adds those that a body at rest feels: springs.
template <class Tree, class T>
ARBOC_COLD void add_springs(const Tree& tree, const T* q, T* tau) {
  if (!tree.joint_forces) return;
  for (const auto& body : tree.body) {
    const auto& f = body.forces;
    if (vanishes(f.stiffness) || freedoms(body.motion) != 1) continue;
    T& entry = tau[body.v];
    entry = entry + body.multiplier * (T(f.stiffness) * (coordinate(body, q) - T(f.neutral)));
  }
}

/// Adds the rotors to the diagonal of M.
template <class Tree, class Matrix>
ARBOC_COLD void add_rotors(const Tree& tree, Matrix& M) {
  if (!tree.joint_forces) return;
  for (const auto& body : tree.body) {
    if (vanishes(body.forces.rotor)) continue;
    for (int d = 0; d < freedoms(body.motion); ++d) {
      auto& entry = M(body.v + d, body.v + d);
      entry = entry + (body.multiplier * body.multiplier) * body.forces.rotor;
    }
  }
}

/// Adds the derivatives of the others to those of tau with respect to q and v.
template <class Tree, class T, class Square>
ARBOC_COLD void add_joint_force_derivatives(const Tree& tree, const T* v, Square& dtau_dq,
                                            Square& dtau_dv) {
  if (!tree.joint_forces) return;
  for (const auto& body : tree.body) {
    const auto& f = body.forces;
    const double square = body.multiplier * body.multiplier;
    for (int d = 0; d < freedoms(body.motion); ++d) {
      const int k = body.v + d;
      T slope = T(f.damping);
      if (!vanishes(f.friction))
        slope = slope + friction_slope(T(f.friction), rate(body, v, d), tree.friction_velocity);
      dtau_dv(k, k) = dtau_dv(k, k) + square * slope;
      if (freedoms(body.motion) == 1) dtau_dq(k, k) = dtau_dq(k, k) + T(square * f.stiffness);
    }
  }
}

}  // namespace arboc

// Movement along the tangent space: q, v -> q (+) v, and its derivatives.
//
// v is a displacement along the axes of each joint's body.  A floating joint moves by the
// exponential of SE(3): with x = |phi|^2 and the entire functions c_k (runtime/arboc/scalar.hpp)
//   p + R V(phi) l,  V = 1 + c_2(x) [phi] + c_3(x) [phi]^2,  quaternion (c_1(x/4) phi / 2,
//   c_0(x/4)).
// A spherical joint turns likewise, and cosine and sine of an unbounded one turn by the angle.
// A planar joint moves by that of SE(2), whose V is a rotation by half the angle times c_1.  Other
// joints add.  docs/theory.md section 8.  Followers of mimic joints have no coordinate of their
// own.
#pragma once
#include "algorithms/rigid_motion.h"
#include "algorithms/twist.h"

namespace arboc {

template <class T>
void integrate_floating(const T* q, const T* v, T* q1) {
  const Vector3<T> l{v[0], v[1], v[2]}, phi{v[3], v[4], v[5]};
  const T y = T(0.25) * dot(phi, phi);
  const T half2 = stumpff<2>(y), half3 = stumpff<3>(y);
  const T half1 = T(1) - y * half3, cosine = T(1) - y * half2;
  const T c2 = T(0.5) * (half1 * half1), c3 = T(0.25) * (half3 + half1 * half2);
  const Vector3<T> turning = cross(phi, l);
  const Vector3<T> along = l + c2 * turning + c3 * cross(phi, turning);
  const Vector3<T> u{q[3], q[4], q[5]};
  const Vector3<T> p = Vector3<T>{q[0], q[1], q[2]} + rotate_by_quaternion(u, q[6], along);
  const Vector3<T> turn = (T(0.5) * half1) * phi;
  const Vector3<T> imaginary = q[6] * turn + cosine * u + cross(u, turn);
  for (int i = 0; i < 3; ++i) {
    q1[i] = p[i];
    q1[3 + i] = imaginary[i];
  }
  q1[6] = q[6] * cosine - dot(u, turn);
}

template <class T>
void integrate_planar(const T* q, const T* v, T* q1) {
  const T half = T(0.5) * v[2];
  PlanarRotation<T> turn;
  sincos(q[2] + half, turn.s, turn.c);
  const T scale = stumpff<1>(half * half);
  const Vector3<T> slide = rotate_z(turn, Vector3<T>{scale * v[0], scale * v[1], T(0)});
  q1[0] = q[0] + slide.x;
  q1[1] = q[1] + slide.y;
  q1[2] = q[2] + v[2];
}

/// The turn of a floating joint.
template <class T>
void integrate_spherical(const T* q, const T* v, T* q1) {
  const T o(0);
  const T q_floating[] = {o, o, o, q[0], q[1], q[2], q[3]},
          v_floating[] = {o, o, o, v[0], v[1], v[2]};
  T result[7];
  integrate_floating(q_floating, v_floating, result);
  for (int i = 0; i < 4; ++i) q1[i] = result[3 + i];
}

/// On the unit circle.
template <class T>
void integrate_circle(const T* q, const T* v, T* q1) {
  PlanarRotation<T> turn;
  sincos(v[0], turn.s, turn.c);
  turn = compose(turn, PlanarRotation<T>{q[0], q[1]});
  q1[0] = turn.c;
  q1[1] = turn.s;
}

/// q (nq), v (nv) -> q1 (nq).
template <class Tree, class T>
void integrate(const Tree& tree, const T* q, const T* v, T* q1) {
  for (const auto& body : tree.body) {
    enter_block(q, body.link, "integrate");
    switch (body.motion) {
      case Motion::kWorld: break;
      case Motion::kFloating: integrate_floating(q + body.q, v + body.v, q1 + body.q); break;
      case Motion::kPlanar: integrate_planar(q + body.q, v + body.v, q1 + body.q); break;
      case Motion::kSpherical: integrate_spherical(q + body.q, v + body.v, q1 + body.q); break;
      default:
        if (body.circle)
          integrate_circle(q + body.q, v + body.v, q1 + body.q);
        else
          q1[body.q] = q[body.q] + v[body.v];
    }
  }
}

/// By v of a floating joint; by q it is the adjoint of exp(-v), by v the right Jacobian.  Both are
/// functions of ad_v, block by block polynomials in [phi] and their change along l.
template <class T>
void integrate_floating_derivatives(const T* v, BlockView<T> dq, BlockView<T> dv) {
  const SkewPowers<T> at({v[0], v[1], v[2]}, {v[3], v[4], v[5]});
  const T& x = at.x;
  const T c4 = stumpff<4>(x), c5 = stumpff<5>(x);
  const T c2 = T(0.5) - x * c4, c3 = T(1.0 / 6) - x * c5;
  const T c1 = T(1) - x * c3;
  const T dc1 = at.change * (c3 - c2), dc2 = at.change * (T(2) * c4 - c3);
  const T dc3 = at.change * (T(3) * c5 - c4);
  at.write(-c1, c2, -dc1, dc2, dq);
  at.write(-c2, c3, -dc2, dc3, dv);
}

template <class T>
void integrate_planar_derivatives(const T* v, BlockView<T> dq, BlockView<T> dv) {
  const T &lx = v[0], &ly = v[1], &t = v[2];
  const T x = t * t;
  const T c2 = stumpff<2>(x), c3 = stumpff<3>(x);
  const T c1 = T(1) - x * c3;
  const T turn2 = t * c2, turn3 = t * c3;
  write_planar(T(1) - x * c2, t * c1, turn2 * lx - c1 * ly, turn2 * ly + c1 * lx, dq);
  write_planar(c1, turn2, turn3 * lx - c2 * ly, turn3 * ly + c2 * lx, dv);
}

/// The angular part of a floating joint's.
template <class T>
void copy_angular_part(const T (&whole)[36], BlockView<T> block) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) block(i, j) = whole[6 * (3 + i) + 3 + j];
}

template <class T>
void integrate_spherical_derivatives(const T* v, BlockView<T> dq, BlockView<T> dv) {
  const T o(0);
  const T floating[] = {o, o, o, v[0], v[1], v[2]};
  T whole_q[36], whole_v[36];
  integrate_floating_derivatives(floating, BlockView<T>{whole_q, 6}, BlockView<T>{whole_v, 6});
  copy_angular_part(whole_q, dq);
  copy_angular_part(whole_v, dv);
}

/// q (nq), v (nv) -> the change of q1 in its tangent space with q in its, and with v: nv x nv,
/// row-major.
template <class Tree, class T>
void integrate_derivatives(const Tree& tree, const T* q, const T* v, T* dq1_dq, T* dq1_dv) {
  const int n = tree.nv;
  fill_zero(dq1_dq, n * n);
  fill_zero(dq1_dv, n * n);
  for (const auto& body : tree.body) {
    if (body.motion == Motion::kWorld) continue;
    enter_block(q, body.link, "integrate");
    const BlockView<T> dq{dq1_dq + body.v * (n + 1), n}, dv{dq1_dv + body.v * (n + 1), n};
    switch (body.motion) {
      case Motion::kFloating: integrate_floating_derivatives(v + body.v, dq, dv); break;
      case Motion::kPlanar: integrate_planar_derivatives(v + body.v, dq, dv); break;
      case Motion::kSpherical: integrate_spherical_derivatives(v + body.v, dq, dv); break;
      default: dq(0, 0) = dv(0, 0) = T(1);
    }
  }
}

}  // namespace arboc

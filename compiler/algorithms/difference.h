// Displacement between two configurations: q0, q1 -> d with q0 (+) d = q1, the inverse of
// integrate.h, and its derivatives.
//
// The angle of a floating, spherical or unbounded joint is at most pi, and not continuous there.
// Angles of other joints are subtracted as they are; a planar joint's formula is singular where
// they differ by 2 pi n, n
// != 0.
#pragma once
#include "algorithms/integrate.h"
#include "algorithms/rigid_motion.h"
#include "algorithms/twist.h"

namespace arboc {

/// Imaginary part u and real part w of conj(q0) q1.
template <class T>
struct RelativeTurn {
  Vector3<T> u;
  T w;

  RelativeTurn(const T* q0, const T* q1) {
    const Vector3<T> a{q0[0], q0[1], q0[2]}, b{q1[0], q1[1], q1[2]};
    u = q0[3] * b - q1[3] * a - cross(a, b);
    w = q0[3] * q1[3] + dot(a, b);
  }
};

/// What leads from q0 to q1, along the axes of q0.
template <class T>
Vector3<T> floating_way(const T* q0, const T* q1) {
  const Vector3<T> way{q1[0] - q0[0], q1[1] - q0[1], q1[2] - q0[2]};
  return rotate_by_quaternion(Vector3<T>{-q0[3], -q0[4], -q0[5]}, q0[6], way);
}

/// V^-1(phi) a = a - phi x a / 2 + b phi x (phi x a).
template <class T>
Vector3<T> unwound(const Vector3<T>& phi, const T& b, const Vector3<T>& a) {
  const Vector3<T> turning = cross(phi, a);
  return a - T(0.5) * turning + b * cross(phi, turning);
}

template <class T>
void difference_floating(const T* q0, const T* q1, T* d) {
  const RelativeTurn<T> turn(q0 + 3, q1 + 3);
  const Vector3<T> phi = quaternion_log(turn.w) * turn.u;
  const Vector3<T> l = unwound(phi, log_curvature(turn.w), floating_way(q0, q1));
  for (int i = 0; i < 3; ++i) {
    d[i] = l[i];
    d[3 + i] = phi[i];
  }
}

template <class T>
void difference_planar(const T* q0, const T* q1, T* d) {
  const T half = T(0.5) * (q1[2] - q0[2]);
  PlanarRotation<T> turn;
  sincos(q0[2] + half, turn.s, turn.c);
  const Vector3<T> way = rotate_back_z(turn, Vector3<T>{q1[0] - q0[0], q1[1] - q0[1], T(0)});
  const T scale = T(1) / stumpff<1>(half * half);
  d[0] = scale * way.x;
  d[1] = scale * way.y;
  d[2] = q1[2] - q0[2];
}

template <class T>
void difference_spherical(const T* q0, const T* q1, T* d) {
  const RelativeTurn<T> turn(q0, q1);
  const Vector3<T> phi = quaternion_log(turn.w) * turn.u;
  for (int i = 0; i < 3; ++i) d[i] = phi[i];
}

/// Of points of the unit circle that are not opposite: by cosine and sine of half the angle.
template <class T>
void difference_circle(const T* q0, const T* q1, T* d) {
  using std::sqrt;
  const T c = q0[0] * q1[0] + q0[1] * q1[1], s = q0[0] * q1[1] - q0[1] * q1[0];
  const T half = sqrt(T(0.5) * (T(1) + c));
  d[0] = quaternion_log(half) * ((T(0.5) * s) / half);
}

/// q0, q1 (nq) -> d (nv).
template <class Tree, class T>
void difference(const Tree& tree, const T* q0, const T* q1, T* d) {
  for (const auto& body : tree.body) {
    enter_block(q0, body.link, "difference");
    const int q = body.q;
    switch (body.motion) {
      case Motion::kWorld: break;
      case Motion::kFloating: difference_floating(q0 + q, q1 + q, d + body.v); break;
      case Motion::kPlanar: difference_planar(q0 + q, q1 + q, d + body.v); break;
      case Motion::kSpherical: difference_spherical(q0 + q, q1 + q, d + body.v); break;
      default:
        if (body.circle)
          difference_circle(q0 + q, q1 + q, d + body.v);
        else
          d[body.v] = q1[q] - q0[q];
    }
  }
}

/// b(x) of V^-1 and its derivative where they are differences of entire functions:
///   b = (c_3 - 2 c_4) / (2 c_2),  db/dx = b^2 - c_2'' / c_2,  c_2'' = (8 c_6 - 5 c_5 + c_4) / 4.
template <class T>
struct Unwinding {
  T b, db;

  explicit Unwinding(const T& x) {
    const T c5 = stumpff<5>(x), c6 = stumpff<6>(x);
    const T c4 = T(1.0 / 24) - x * c6, c3 = T(1.0 / 6) - x * c5;
    const T inverse = T(1) / (T(1) - T(2) * (x * c4));  // of 2 c_2
    b = (c3 - T(2) * c4) * inverse;
    db = b * b - (T(4) * c6 - T(2.5) * c5 + T(0.5) * c4) * inverse;
  }
};

/// By q1 the inverse of the right Jacobian at d, by q0 minus that at -d.
template <class T>
void difference_floating_derivatives(const T* q0, const T* q1, BlockView<T> d0, BlockView<T> d1) {
  const RelativeTurn<T> turn(q0 + 3, q1 + 3);
  const Vector3<T> phi = quaternion_log(turn.w) * turn.u;
  const Unwinding<T> curve(dot(phi, phi));
  const SkewPowers<T> at(unwound(phi, curve.b, floating_way(q0, q1)), phi);
  const T db = T(2) * at.change * curve.db;
  at.write(T(0.5), curve.b, T(0), db, d1);
  at.write(T(-0.5), curve.b, T(0), db, d0);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) d0(i, j) = -d0(i, j);
}

template <class T>
void difference_planar_derivatives(const T* q0, const T* q1, BlockView<T> d0, BlockView<T> d1) {
  PlanarRotation<T> turn;
  sincos(q0[2], turn.s, turn.c);
  const Vector3<T> way = rotate_back_z(turn, Vector3<T>{q1[0] - q0[0], q1[1] - q0[1], T(0)});
  const T t = q1[2] - q0[2], x = t * t, half = T(0.5) * t;
  const T c3 = stumpff<3>(x), c4 = stumpff<4>(x);
  const T b = (c3 - T(2) * c4) / (T(1) - T(2) * (x * c4));
  const T c = T(1) - b * x, turned = b * t;
  const T lx = c * way.x + half * way.y, ly = c * way.y - half * way.x;
  const T ex = turned * lx, ey = turned * ly, ox = T(0.5) * ly, oy = T(0.5) * lx;
  write_planar(c, -half, ex + ox, ey - oy, d1);
  write_planar(-c, -half, ox - ex, -(oy + ey), d0);
  d0(2, 2) = T(-1);
}

template <class T>
void difference_spherical_derivatives(const T* q0, const T* q1, BlockView<T> d0, BlockView<T> d1) {
  const T o(0);
  const T a[] = {o, o, o, q0[0], q0[1], q0[2], q0[3]}, b[] = {o, o, o, q1[0], q1[1], q1[2], q1[3]};
  T whole0[36], whole1[36];
  difference_floating_derivatives(a, b, BlockView<T>{whole0, 6}, BlockView<T>{whole1, 6});
  copy_angular_part(whole0, d0);
  copy_angular_part(whole1, d1);
}

/// q0, q1 (nq) -> the change of d with q0 and with q1 in their tangent spaces: nv x nv, row-major.
template <class Tree, class T>
void difference_derivatives(const Tree& tree, const T* q0, const T* q1, T* dd_dq0, T* dd_dq1) {
  const int n = tree.nv;
  fill_zero(dd_dq0, n * n);
  fill_zero(dd_dq1, n * n);
  for (const auto& body : tree.body) {
    if (body.motion == Motion::kWorld) continue;
    enter_block(q0, body.link, "difference");
    const BlockView<T> d0{dd_dq0 + body.v * (n + 1), n}, d1{dd_dq1 + body.v * (n + 1), n};
    const T *a = q0 + body.q, *b = q1 + body.q;
    switch (body.motion) {
      case Motion::kFloating: difference_floating_derivatives(a, b, d0, d1); break;
      case Motion::kPlanar: difference_planar_derivatives(a, b, d0, d1); break;
      case Motion::kSpherical: difference_spherical_derivatives(a, b, d0, d1); break;
      default: d1(0, 0) = T(1); d0(0, 0) = T(-1);
    }
  }
}

}  // namespace arboc

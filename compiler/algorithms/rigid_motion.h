// Rotations and small displacements of free bodies, for integrate.h and difference.h.
#pragma once
#include "algorithms/joint.h"

namespace arboc {

/// R(u, w) a of a unit quaternion with imaginary part u.
template <class T>
Vector3<T> rotate_by_quaternion(const Vector3<T>& u, const T& w, const Vector3<T>& a) {
  const Vector3<T> t = T(2) * cross(u, a);
  return a + w * t + cross(u, t);
}

/// A square block on the diagonal of a row-major matrix.
template <class T>
struct BlockView {
  T* data = nullptr;
  int stride = 0;
  T& operator()(int i, int j) const { return data[i * stride + j]; }
};

/// Writes (c s fx; -s c fy; 0 0 1).
template <class T>
void write_planar(const T& c, const T& s, const T& fx, const T& fy, BlockView<T> out) {
  out(0, 0) = out(1, 1) = c;
  out(0, 1) = s;
  out(1, 0) = -s;
  out(0, 2) = fx;
  out(1, 2) = fy;
  out(2, 0) = out(2, 1) = T(0);
  out(2, 2) = T(1);
}

/// Polynomials 1 + a [phi] + b [phi]^2 whose coefficients depend on x = |phi|^2, and their
/// derivative along l; the two blocks of a function of ad(l, phi) = ([phi] [l]; 0 [phi]).
template <class T>
struct SkewPowers {
  Vector3<T> l, phi;
  T x;               ///< |phi|^2
  T change;          ///< phi . l, half the derivative of x along l
  Symmetric3<T> S;   ///< [phi]^2
  Symmetric3<T> dS;  ///< [phi] [l] + [l] [phi]

  SkewPowers(const Vector3<T>& linear, const Vector3<T>& angular)
      : l(linear), phi(angular), x(dot(angular, angular)), change(dot(angular, linear)) {
    const T xx = phi.x * phi.x, yy = phi.y * phi.y, zz = phi.z * phi.z;
    S = {-(yy + zz), -(xx + zz), -(xx + yy), phi.x * phi.y, phi.x * phi.z, phi.y * phi.z};
    const T lx = phi.x * l.x, ly = phi.y * l.y, lz = phi.z * l.z;
    dS = {T(-2) * (ly + lz),         T(-2) * (lx + lz),         T(-2) * (lx + ly),
          phi.x * l.y + phi.y * l.x, phi.x * l.z + phi.z * l.x, phi.y * l.z + phi.z * l.y};
  }

  /// Writes (f(phi) df; 0 f(phi)), 6 x 6; da and db are the derivatives of a and b along l.
  void write(const T& a, const T& b, const T& da, const T& db, BlockView<T> out) const {
    const Symmetric3<T> even = scaled(b, S), change_even = scaled(b, dS) + scaled(db, S);
    const Vector3<T> odd = a * phi, change_odd = a * l + da * phi;
    const Symmetric3<T> identity{T(1), T(1), T(1), T(0), T(0), T(0)};
    write(identity + even, odd, {out.data, out.stride});
    write(change_even, change_odd, {out.data + 3, out.stride});
    write(identity + even, odd, {out.data + 3 * (out.stride + 1), out.stride});
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) out(3 + i, j) = T(0);
  }

 private:
  static Symmetric3<T> scaled(const T& s, const Symmetric3<T>& A) {
    return {s * A.xx, s * A.yy, s * A.zz, s * A.xy, s * A.xz, s * A.yz};
  }
  /// even + [odd]
  static void write(const Symmetric3<T>& even, const Vector3<T>& odd, BlockView<T> out) {
    out(0, 0) = even.xx;
    out(1, 1) = even.yy;
    out(2, 2) = even.zz;
    out(0, 1) = even.xy - odd.z;
    out(1, 0) = even.xy + odd.z;
    out(0, 2) = even.xz + odd.y;
    out(2, 0) = even.xz - odd.y;
    out(1, 2) = even.yz - odd.x;
    out(2, 1) = even.yz + odd.x;
  }
};

}  // namespace arboc

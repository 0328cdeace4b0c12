#include "tree/mass_moments.h"

#include "tree/tallied.h"

namespace arboc {
namespace {

/// a b^T + b a^T
Symmetric3<Tallied> symmetric_product(const Vector3<Tallied>& a, const Vector3<Tallied>& b) {
  return {2.0 * a.x * b.x,       2.0 * a.y * b.y,       2.0 * a.z * b.z,
          a.x * b.y + a.y * b.x, a.x * b.z + a.z * b.x, a.y * b.z + a.z * b.y};
}

}  // namespace

MassMoments mass_moments(const Inertial& inertial) {
  const Symmetric3<double>& I = inertial.inertia;
  // Sigma = tr(I) / 2 - I, written without the cancellation of the diagonal.
  const MassMoments at_com{inertial.mass,
                           {},
                           {(I.yy + I.zz - I.xx) / 2, (I.xx + I.zz - I.yy) / 2,
                            (I.xx + I.yy - I.zz) / 2, 0.0 - I.xy, 0.0 - I.xz, 0.0 - I.yz}};
  return move(at_com, rotation(inertial.origin), inertial.origin.xyz);
}

MassMoments move(const MassMoments& moments, const Matrix3<double>& R, const Vector3<double>& p) {
  const Vector3<Tallied> k = tallied(R) * tallied(moments.h), at = tallied(p);
  const Tallied m = moments.m;
  const Vector3<Tallied> t = k + Tallied(0.5) * (m * at);
  return {moments.m, clean(k + m * at),
          clean(congruence(tallied(R), tallied(moments.Sigma)) + symmetric_product(t, at))};
}

MassMoments operator+(const MassMoments& a, const MassMoments& b) {
  return {clean(Tallied(a.m) + b.m), clean(tallied(a.h) + tallied(b.h)),
          clean(tallied(a.Sigma) + tallied(b.Sigma))};
}

}  // namespace arboc

#include "tree/factor.h"

#include <cmath>

#include "tree/tallied.h"

namespace arboc {
namespace {

Turn unit(double c, double s) {
  // Exact where one of the two is zero, which hypot alone does not promise.
  if (s == 0) return {c < 0 ? -1.0 : 1.0, 0.0};
  if (c == 0) return {0.0, s < 0 ? -1.0 : 1.0};
  const double length = std::sqrt(c * c + s * s);
  return clean_unit(Turn{c / length, s / length});
}

}  // namespace

Factors factor(const Matrix3<double>& R) {
  Factors f;
  const double sine = std::sqrt(R(0, 2) * R(0, 2) + R(1, 2) * R(1, 2));
  if (sine > 0) f.gamma = unit(-R(1, 2), R(0, 2));
  // Not normalised by the cosine, which may have been cleaned to 1 beside a sine of 1e-9.
  f.alpha = clean_unit(Turn{R(2, 2), sine});
  const Vector3<double> x =
      rotate_back_x(f.alpha, rotate_back_z(f.gamma, Vector3<double>(column(R, 0))));
  f.theta = unit(clean_unit(x.x), clean_unit(x.y));
  return f;
}

Matrix3<double> rotation(const Factors& f) {
  Matrix3<double> R;
  for (int j = 0; j < 3; ++j) {
    Vector3<double> e;
    e[j] = 1;
    const Vector3<double> a = rotate_z(f.gamma, rotate_x(f.alpha, rotate_z(f.theta, e)));
    for (int i = 0; i < 3; ++i) R(i, j) = a[i];
  }
  return clean_unit(R);
}

}  // namespace arboc

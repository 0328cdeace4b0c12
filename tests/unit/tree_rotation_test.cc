// The cheap forms of rotations and congruences against plain matrix products.
#include <gtest/gtest.h>

#include <random>

#include "spatial/rotation.h"

namespace arboc::test {
namespace {

using Planar = PlanarRotation<double>;

Matrix3<double> about_z(const Planar& r) {
  return {{{r.c, -r.s, 0.0}, {r.s, r.c, 0.0}, {0.0, 0.0, 1.0}}};
}
Matrix3<double> about_x(const Planar& r) {
  return {{{1.0, 0.0, 0.0}, {0.0, r.c, -r.s}, {0.0, r.s, r.c}}};
}

void expect_near(const Matrix3<double>& A, const Matrix3<double>& B) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(A(i, j), B(i, j), 1e-14);
}
void expect_near(const Vector3<double>& a, const Vector3<double>& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-14);
}

class Rotation : public testing::TestWithParam<int> {
 protected:
  Rotation() : random_(static_cast<unsigned>(GetParam())) {
    for (auto& row : A_.m)
      for (double& x : row) x = uniform_(random_);
    S_ = symmetric(A_);
    a_ = {uniform_(random_), uniform_(random_), uniform_(random_)};
    const double angle = 3 * uniform_(random_);
    r_ = {std::cos(angle), std::sin(angle)};
  }

  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
  Matrix3<double> A_;
  Symmetric3<double> S_;
  Vector3<double> a_;
  Planar r_;
};

TEST_P(Rotation, OfVectors) {
  expect_near(rotate_z(r_, a_), about_z(r_) * a_);
  expect_near(rotate_x(r_, a_), about_x(r_) * a_);
  expect_near(rotate_back_z(r_, a_), transpose(about_z(r_)) * a_);
  expect_near(rotate_back_x(r_, a_), transpose(about_x(r_)) * a_);
  expect_near(about_z(compose(r_, Planar{0.6, 0.8})), about_z(r_) * about_z({0.6, 0.8}));
  expect_near(transpose_apply(A_, a_), transpose(A_) * a_);
}

TEST_P(Rotation, OfMatrices) {
  const Matrix3<double> Z = about_z(r_), X = about_x(r_);
  expect_near(full(congruence_z(r_, S_)), Z * full(S_) * transpose(Z));
  expect_near(full(congruence_x(r_, S_)), X * full(S_) * transpose(X));
  expect_near(congruence_z(r_, A_), Z * A_ * transpose(Z));
  expect_near(congruence_x(r_, A_), X * A_ * transpose(X));
  expect_near(full(congruence(A_, S_)), A_ * full(S_) * transpose(A_));
}

TEST_P(Rotation, OfQuaternions) {
  double q[4] = {uniform_(random_), uniform_(random_), uniform_(random_), uniform_(random_)};
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& x : q) x /= norm;
  const Matrix3<double> R = rotation_of_quaternion(q);
  expect_near(R * transpose(R), Matrix3<double>::identity());
  const Vector3<double> axis{q[0], q[1], q[2]};
  expect_near(R * axis, axis);
  EXPECT_NEAR(R(0, 0) + R(1, 1) + R(2, 2), 4 * q[3] * q[3] - 1, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Rotation, testing::Range(0, 10));

}  // namespace
}  // namespace arboc::test

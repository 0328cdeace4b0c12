#include "scalars.hpp"

#include <arboc/measures/torque.hpp>
#include <cmath>

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

using Eigen::Map;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Square : Scalar {
  int arguments() const override { return 1; }
  double value(const double* z) const override { return z[0] * z[0]; }
  void derivatives(const double* z, double* g, double* H) const override {
    g[0] = 2 * z[0];
    H[0] = 2;
  }
};

struct Quadratic : Scalar {
  MatrixXd Q;
  explicit Quadratic(MatrixXd q) : Q(std::move(q)) {}
  int arguments() const override { return static_cast<int>(Q.rows()); }
  double value(const double* z) const override {
    const Map<const VectorXd> x(z, Q.rows());
    return x.dot(Q * x) / 2;
  }
  void derivatives(const double* z, double* g, double* H) const override {
    Map<VectorXd>(g, Q.rows()) = Q * Map<const VectorXd>(z, Q.rows());
    Map<MatrixXd>(H, Q.rows(), Q.rows()) = Q;
  }
  bool curved(int i, int j) const override { return Q(i, j) != 0; }
};

struct RoundedNorm : Scalar {
  int n;
  double e;
  RoundedNorm(int count, double edge) : n(count), e(edge) {}
  int arguments() const override { return n; }
  double value(const double* z) const override {
    return std::sqrt(Map<const VectorXd>(z, n).squaredNorm() + e * e);
  }
  void derivatives(const double* z, double* g, double* H) const override {
    const double r = value(z);
    Map<VectorXd> slope(g, n);
    slope = Map<const VectorXd>(z, n) / r;
    Map<MatrixXd>(H, n, n) = (MatrixXd::Identity(n, n) - slope * slope.transpose()) / r;
  }
};

struct NormalisedSquare : Scalar {
  double lower, upper;
  NormalisedSquare(double l, double u) : lower(l), upper(u) {}
  int arguments() const override { return 1; }
  double value(const double* z) const override {
    return normalised_torque_squared(z[0], lower, upper).value;
  }
  void derivatives(const double* z, double* g, double* H) const override {
    const Jet1<double> jet = normalised_torque_squared(z[0], lower, upper);
    g[0] = jet.d;
    H[0] = jet.dd;
  }
};

struct NormalisedNorm : Scalar {
  TorqueLimits limits;
  double p;
  NormalisedNorm(const VectorXd& l, const VectorXd& u, double power) : limits(l, u), p(power) {}
  int arguments() const override { return static_cast<int>(limits.size()); }
  double value(const double* z) const override {
    return normalised_torque_norm(Map<const VectorXd>(z, limits.size()), limits, p).value;
  }
  void derivatives(const double* z, double* g, double* H) const override {
    const Eigen::Index n = limits.size();
    const TorqueMeasure m = normalised_torque_norm(Map<const VectorXd>(z, n), limits, p);
    Map<VectorXd>(g, n) = m.gradient;
    Map<MatrixXd>(H, n, n) = m.hessian();
  }
};

/// 1 - a.u/|u|.  With n = u/|u| and c = a.n:  d/du = -(a - c n)/|u|,
/// d2/du2 = (a n^T + n a^T + c 1 - 3 c n n^T)/|u|^2,  d2/du da = -(1 - n n^T)/|u|.
struct OffDirection : Scalar {
  int arguments() const override { return 6; }
  double value(const double* z) const override {
    const Eigen::Vector3d u(z + 3);
    return 1 - Eigen::Vector3d(z).dot(u) / u.norm();
  }
  void derivatives(const double* z, double* g, double* H) const override {
    const Eigen::Vector3d a(z), u(z + 3);
    const double r = u.norm();
    const Eigen::Vector3d n = u / r;
    const double c = a.dot(n);
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity(), nn = n * n.transpose();
    Map<Eigen::Matrix<double, 6, 1>> slope(g);
    slope << -n, -(a - c * n) / r;
    Map<Eigen::Matrix<double, 6, 6>> h(H);
    h.setZero();
    h.topRightCorner<3, 3>() = -(one - nn) / r;
    h.bottomLeftCorner<3, 3>() = h.topRightCorner<3, 3>().transpose();
    h.bottomRightCorner<3, 3>() =
        (a * n.transpose() + n * a.transpose() + c * one - 3 * c * nn) / (r * r);
  }
  bool curved(int i, int j) const override { return i >= 3 || j >= 3; }
};

}  // namespace

ScalarPointer square() {
  static const ScalarPointer one = std::make_shared<Square>();
  return one;
}
ScalarPointer quadratic(const MatrixXd& Q) { return std::make_shared<Quadratic>(Q); }
ScalarPointer dot(int n) {
  MatrixXd Q = MatrixXd::Zero(2 * n, 2 * n);
  Q.topRightCorner(n, n).setIdentity();
  Q.bottomLeftCorner(n, n).setIdentity();
  return quadratic(Q);
}
ScalarPointer squared_norm(int n) { return quadratic(2 * MatrixXd::Identity(n, n)); }
ScalarPointer rounded_norm(int n, double e) { return std::make_shared<RoundedNorm>(n, e); }
ScalarPointer normalised_square(double lower, double upper) {
  return std::make_shared<NormalisedSquare>(lower, upper);
}
ScalarPointer normalised_norm(const VectorXd& lower, const VectorXd& upper, double p) {
  return std::make_shared<NormalisedNorm>(lower, upper, p);
}
ScalarPointer off_direction() { return std::make_shared<OffDirection>(); }

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#include "reference/regressor.h"

namespace arboc {
namespace {

using spatial6::crf;
using spatial6::Matrix6;
using spatial6::Vector6;

constexpr int kParameters = 10;

/// Row and column of Ixx Ixy Iyy Ixz Iyz Izz.
constexpr int kRow[] = {0, 0, 1, 0, 1, 2}, kColumn[] = {0, 1, 1, 2, 2, 2};

/// The inertia of the parameter k alone, of size 1.  [RBDA] (2.63)
template <class S>
Matrix6<S> unit_inertia(int k) {
  Matrix6<S> I = Matrix6<S>::Zero();
  if (k == 0) I.template bottomRightCorner<3, 3>().setIdentity();
  if (1 <= k && k <= 3) {
    I.template topRightCorner<3, 3>() = spatial6::skew(spatial6::Vec3<S>::Unit(k - 1));
    I.template bottomLeftCorner<3, 3>() = -I.template topRightCorner<3, 3>();
  }
  if (k >= 4) I(kRow[k - 4], kColumn[k - 4]) = I(kColumn[k - 4], kRow[k - 4]) = 1.;
  return I;
}

/// Indices of the bodies that joints move, in the order of the joints.
template <class S>
std::vector<int> moved_bodies(const ReferenceOf<S>& reference) {
  std::vector<int> result;
  for (int i = 1; i <= reference.nb(); ++i)
    if (reference.bodies()[i].motion.cols() > 0) result.push_back(i);
  return result;
}

}  // namespace

template <class S>
MatrixOf<S> regressor(const ReferenceOf<S>& reference, const VectorOf<S>& q, const VectorOf<S>& v,
                      const VectorOf<S>& a) {
  const auto X = reference.transforms(q);
  const auto velocity = reference.velocities(X, v);
  const auto acceleration = reference.accelerations(X, velocity, v, a, reference.rising());
  const std::vector<int> moved = moved_bodies(reference);
  MatrixOf<S> Y = MatrixOf<S>::Zero(reference.nv(), kParameters * moved.size());
  for (size_t b = 0; b < moved.size(); ++b) {
    const int at = moved[b];
    Eigen::Matrix<S, 6, kParameters> F;
    for (int k = 0; k < kParameters; ++k) {
      const Matrix6<S> I = unit_inertia<S>(k);
      F.col(k) = I * acceleration[at] + crf(velocity[at]) * (I * velocity[at]);
    }
    for (int i = at; i > 0; i = reference.bodies()[i].parent) {
      const auto& body = reference.bodies()[i];
      Y.block(body.at.v, kParameters * b, body.motion.cols(), kParameters) +=
          body.at.multiplier * (body.motion.transpose() * F);
      F = (X[i].transpose() * F).eval();
    }
  }
  return Y;
}

Eigen::VectorXd body_parameters(const Model& model) {
  const Reference reference(model);
  const auto& bodies = reference.bodies();
  std::vector<Matrix6<double>> I(bodies.size());
  for (size_t i = 0; i < bodies.size(); ++i) I[i] = bodies[i].I;
  for (int i = reference.nb(); i > 0; --i) {
    if (bodies[i].motion.cols() > 0) continue;
    const Matrix6<double> X = spatial6::plucker(bodies[i].T_tree.R, bodies[i].T_tree.p);
    I[bodies[i].parent] += X.transpose() * I[i] * X;
  }
  const std::vector<int> moved = moved_bodies(reference);
  Eigen::VectorXd result(kParameters * moved.size());
  for (size_t b = 0; b < moved.size(); ++b) {
    const Matrix6<double>& own = I[moved[b]];
    auto pi = result.segment<kParameters>(kParameters * b);
    pi.head<4>() << own(5, 5), own(2, 4), own(0, 5), own(1, 3);  // [m c], its entries zy xz yx
    for (int k = 0; k < 6; ++k) pi[4 + k] = own(kRow[k], kColumn[k]);
  }
  return result;
}

template Eigen::MatrixXd regressor(const Reference&, const VectorOf<double>&,
                                   const VectorOf<double>&, const VectorOf<double>&);
template MatrixOf<Complex> regressor(const ComplexReference&, const VectorOf<Complex>&,
                                     const VectorOf<Complex>&, const VectorOf<Complex>&);

}  // namespace arboc

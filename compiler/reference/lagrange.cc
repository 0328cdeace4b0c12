#include "reference/lagrange.h"

#include <stdexcept>

#include "reference/eigen.h"

namespace arboc {
namespace {

/// Tr(A B^T).
template <class S>
S trace(const Matrix4<S>& A, const Matrix4<S>& B) {
  return A.cwiseProduct(B).sum();
}

/// Derivatives of a link's transform along the coordinates that move it.
template <class S>
std::vector<Matrix4<S>> first_derivatives(const TransformsOf<S>& link) {
  std::vector<Matrix4<S>> dT;
  for (const int k : link.coordinates()) dT.push_back(link.derivative({k}));
  return dT;
}

}  // namespace

Eigen::Matrix4d pseudo_inertia(const Inertial& inertial) {
  const Eigen::Matrix3d R = to_eigen(rotation(inertial.origin));
  const Eigen::Vector3d c = to_eigen(inertial.origin.xyz);
  const double m = inertial.mass;
  const Eigen::Matrix3d I = R * to_eigen(inertial.inertia) * R.transpose() +
                            m * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  Eigen::Matrix4d J;
  J << (-I(0, 0) + I(1, 1) + I(2, 2)) / 2, -I(0, 1), -I(0, 2), m * c.x(),  //
      -I(0, 1), (I(0, 0) - I(1, 1) + I(2, 2)) / 2, -I(1, 2), m * c.y(),    //
      -I(0, 2), -I(1, 2), (I(0, 0) + I(1, 1) - I(2, 2)) / 2, m * c.z(),    //
      m * c.x(), m * c.y(), m * c.z(), m;
  return J;
}

template <class S>
LagrangianOf<S>::LagrangianOf(const Model& model) : reference_(model) {
  for (const Joint& joint : model.joints)
    if (arboc::nv(joint.type) > 1)
      throw std::invalid_argument("Lagrange's equations: joint '" + joint.name +
                                  "' has several coordinates; expand the model");
  const auto& bodies = reference_.bodies();
  for (size_t i = 0; i < model.links.size(); ++i)
    if (model.links[i].inertial && bodies[i + 1].moves)
      masses_.push_back({static_cast<int>(i), pseudo_inertia(*model.links[i].inertial)});
  gravity_ << to_eigen(model.gravity), 0;
}

template <class S>
auto LagrangianOf<S>::terms(const Vector& q, const Vector& v) const -> Terms {
  const int n = nv();
  Terms sum{Matrix::Zero(n, n), Matrix::Zero(n, n), Vector::Zero(n)};
  for (const Mass& mass : masses_) {
    const TransformsOf<S> link(reference_, q, mass.link);
    const std::vector<int>& at = link.coordinates();
    const std::vector<Matrix4<S>> dT = first_derivatives(link);
    const Matrix4<S> J = mass.J.template cast<S>();
    std::vector<Matrix4<S>> turning(at.size(), Matrix4<S>::Zero());  // sum over m of d2T_km v_m
    for (size_t k = 0; k < at.size(); ++k)
      for (size_t m = 0; m <= k; ++m) {
        const Matrix4<S> d2T = link.derivative({at[m], at[k]});
        turning[k] += d2T * v[at[m]];
        if (m != k) turning[m] += d2T * v[at[k]];
      }
    for (size_t k = 0; k < at.size(); ++k) {
      const Matrix4<S> inertial = dT[k] * J, centrifugal = turning[k] * J;
      for (size_t i = 0; i < at.size(); ++i) {
        sum.D(at[i], at[k]) += trace(inertial, dT[i]);
        sum.C(at[i], at[k]) += trace(centrifugal, dT[i]);
      }
      sum.c[at[k]] -= (inertial.col(3).cwiseProduct(gravity_.template cast<S>())).sum();
    }
  }
  return sum;
}

template <class S>
VectorOf<S> LagrangianOf<S>::tau(const Vector& q, const Vector& v, const Vector& a) const {
  const Terms at = terms(q, v);
  return at.D * a + at.C * v + at.c;
}

template <class S>
S LagrangianOf<S>::kinetic(const Vector& q, const Vector& v) const {
  S K = 0;
  for (const Mass& mass : masses_) {
    const TransformsOf<S> link(reference_, q, mass.link);
    const std::vector<Matrix4<S>> dT = first_derivatives(link);
    Matrix4<S> rate = Matrix4<S>::Zero();
    for (size_t k = 0; k < dT.size(); ++k) rate += dT[k] * v[link.coordinates()[k]];
    K += trace<S>(rate * mass.J.template cast<S>(), rate) / 2.;
  }
  return K;
}

template <class S>
S LagrangianOf<S>::potential(const Vector& q) const {
  S P = 0;
  for (const Mass& mass : masses_) {
    const TransformsOf<S> link(reference_, q, mass.link);
    const Eigen::Matrix<S, 4, 1> moment = link.T() * mass.J.template cast<S>().col(3);
    P -= moment.cwiseProduct(gravity_.template cast<S>()).sum();
  }
  return P;
}

template <class S>
MatrixOf<S> LagrangianOf<S>::jacobian(const Vector& q, int link, const Eigen::Vector3d& r) const {
  Matrix J = Matrix::Zero(6, nv());
  const std::vector<PlacementOf<S>> T = reference_.fk(q);
  const spatial6::Vec3<S> point = T[link].p + T[link].R * r.cast<S>();
  for (int i = link + 1; i > 0; i = reference_.bodies()[i].parent) {
    const auto& body = reference_.bodies()[i];
    if (body.motion.cols() == 0) continue;
    const PlacementOf<S>& at = T[i - 1];
    const spatial6::Vec3<S> turn = at.R * body.motion.col(0).template head<3>(),
                            slide = at.R * body.motion.col(0).template tail<3>();
    J.template block<3, 1>(0, body.at.v) +=
        body.at.multiplier * (spatial6::skew(turn) * (point - at.p) + slide);
    J.template block<3, 1>(3, body.at.v) += body.at.multiplier * turn;
  }
  return J;
}

template class LagrangianOf<double>;
template class LagrangianOf<Complex>;

}  // namespace arboc

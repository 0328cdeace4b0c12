// The reference engine's inertia and forward dynamics.
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <type_traits>

#include "reference/reference.h"

namespace arboc {
namespace {

using spatial6::crf;
using spatial6::crm;

/// Of a symmetric matrix.  Cholesky's factorisation of complex ones would conjugate.
template <class S>
using Factored = std::conditional_t<std::is_same_v<S, double>, Eigen::LLT<MatrixOf<S>>,
                                    Eigen::PartialPivLU<MatrixOf<S>>>;

}  // namespace

template <class S>
struct ReferenceOf<S>::Articulated {
  std::vector<Matrix> U;       ///< IA S
  std::vector<Factored<S>> D;  ///< S^T U, with the rotor, factored
  std::vector<Vector> u;       ///< tau - S^T pA
};

// Table 6.2.  A follower's rows and columns are added to its leader's, times the multiplier: this
// is G^T H G with v_full = G v.
template <class S>
MatrixOf<S> ReferenceOf<S>::crba(const Vector& q) const {
  const Matrices6 X = transforms(q);
  Matrices6 Ic(bodies_.size());
  for (int i = 0; i <= nb(); ++i) Ic[i] = bodies_[i].I;
  Matrix H = Matrix::Zero(nv_, nv_);
  const auto add = [&](const Body& row, const Body& column, const Matrix& block) {
    H.block(row.at.v, column.at.v, block.rows(), block.cols()) +=
        row.at.multiplier * column.at.multiplier * block;
  };
  for (int i = nb(); i > 0; --i) {
    const Body& body = bodies_[i];
    Ic[body.parent] += X[i].transpose() * Ic[i] * X[i];
    Matrix F = Ic[i] * body.motion;
    const auto n = F.cols();
    add(body, body, body.motion.transpose() * F + rotor(body) * Matrix::Identity(n, n));
    for (int j = i; bodies_[j].parent > 0;) {
      F = X[j].transpose() * F;
      j = bodies_[j].parent;
      const Matrix block = F.transpose() * bodies_[j].motion;
      add(body, bodies_[j], block);
      add(bodies_[j], body, block.transpose());
    }
  }
  return H;
}

template <class S>
MatrixOf<S> ReferenceOf<S>::minv(const Vector& q) const {
  return Factored<S>(crba(q)).solve(Matrix::Identity(nv_, nv_));
}

template <class S>
VectorOf<S> ReferenceOf<S>::aba(const Vector& q, const Vector& v, const Vector& tau,
                                const Loads& loads) const {
  if (!mimic_) return articulated_body(q, v, tau, loads);
  return Factored<S>(crba(q)).solve(tau - nle(q, v, loads));
}

// Table 7.1.  A fixed joint has an empty S and passes everything on.
template <class S>
auto ReferenceOf<S>::articulated_inertias(const Matrices6& X, const Vectors6& bias,
                                          const Vectors6& c, const Vector& tau) const
    -> Articulated {
  Articulated result{std::vector<Matrix>(bodies_.size()), std::vector<Factored<S>>(bodies_.size()),
                     std::vector<Vector>(bodies_.size())};
  auto& [U, D, u] = result;
  Matrices6 IA(bodies_.size(), Matrix6::Zero());
  Vectors6 pA = bias;
  for (int i = 1; i <= nb(); ++i) IA[i] = bodies_[i].I;
  for (int i = nb(); i > 0; --i) {
    const Body& body = bodies_[i];
    const auto n = body.motion.cols();
    Matrix6 Ia = IA[i];
    Vector6 pa = pA[i] + Ia * c[i];
    if (n > 0) {
      U[i] = IA[i] * body.motion;
      D[i].compute(body.motion.transpose() * U[i] + rotor(body) * Matrix::Identity(n, n));
      u[i] = tau.segment(body.at.v, n) - body.motion.transpose() * pA[i];
      Ia -= U[i] * D[i].solve(U[i].transpose());
      pa = pA[i] + Ia * c[i] + U[i] * D[i].solve(u[i]);
    }
    IA[body.parent] += X[i].transpose() * Ia * X[i];
    pA[body.parent] += X[i].transpose() * pa;
  }
  return result;
}

template <class S>
VectorOf<S> ReferenceOf<S>::articulated_body(const Vector& q, const Vector& qd, const Vector& tau,
                                             const Loads& loads) const {
  const Matrices6 X = transforms(q);
  const Vectors6 v = velocities(X, qd), pushed = applied(q, loads);
  Vectors6 a(bodies_.size()), c(bodies_.size()), pA(bodies_.size(), Vector6::Zero());
  Vector active = tau;
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    c[i] = crm(v[i]) * (body.motion * body.rates(qd));
    pA[i] = crf(v[i]) * (body.I * v[i]) - pushed[i];
    active.segment(body.at.v, body.motion.cols()) -= passive(body, q, qd);
  }
  const auto [U, D, u] = articulated_inertias(X, pA, c, active);
  a[0] = rising();
  Vector qdd(nv_);
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    a[i] = X[i] * a[body.parent] + c[i];
    if (body.motion.cols() == 0) continue;
    const Vector own = D[i].solve(u[i] - U[i].transpose() * a[i]);
    qdd.segment(body.at.v, body.motion.cols()) = own;
    a[i] += body.motion * own;
  }
  return qdd;
}

#define ARBOC_INSTANTIATE(S)                                                            \
  template MatrixOf<S> ReferenceOf<S>::crba(const Vector&) const;                       \
  template MatrixOf<S> ReferenceOf<S>::minv(const Vector&) const;                       \
  template VectorOf<S> ReferenceOf<S>::aba(const Vector&, const Vector&, const Vector&, \
                                           const Loads&) const;
ARBOC_INSTANTIATE(double)
ARBOC_INSTANTIATE(Complex)
#undef ARBOC_INSTANTIATE

}  // namespace arboc

#include "reference/reference.h"

#include "reference/eigen.h"

namespace arboc {

using spatial6::crf;
using spatial6::crm;
using spatial6::Matrix6;
using spatial6::Vector6;

Reference::Reference(const Model& model) : gravity_(to_eigen(model.gravity)) {
  const Coordinates where = coordinates(model);
  nq_ = where.nq;
  nv_ = where.nv;
  bodies_.resize(model.links.size() + 1);
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    Body& body = bodies_[joint.child + 1];
    body.parent = joint.parent + 1;
    body.joint = joint;
    if (arboc::nv(joint.type) > 0) body.at = where.joint[k];
    mimic_ = mimic_ || joint.mimic;
  }
  for (int i = 1; i <= nb(); ++i) {
    Body& body = bodies_[i];
    body.T_tree = {to_eigen(rotation(body.joint.origin)), to_eigen(body.joint.origin.xyz)};
    body.S = motion_subspace(body.joint);
    if (body.S.cols() == 0) body.at = {0, 0, 1, 0};
    if (const auto& inertial = model.links[i - 1].inertial) {
      const Eigen::Matrix3d R = to_eigen(rotation(inertial->origin));
      body.m = inertial->mass;
      body.c = to_eigen(inertial->origin.xyz);
      body.I =
          spatial6::rigid_inertia(body.m, body.c, R * to_eigen(inertial->inertia) * R.transpose());
    }
  }
}

Placement Reference::placement(const Body& body, const Vector& q) const {
  const int n = arboc::nq(body.joint.type);
  const Vector offset = Vector::Constant(n, body.at.offset);
  const Placement J =
      joint_placement(body.joint, body.at.multiplier * q.segment(body.at.q, n) + offset);
  return {body.T_tree.R * J.R, body.T_tree.p + body.T_tree.R * J.p};
}

std::vector<Placement> Reference::fk(const Vector& q) const {
  std::vector<Placement> T(bodies_.size());
  for (int i = 1; i <= nb(); ++i) {
    const Placement& up = T[bodies_[i].parent];
    const Placement own = placement(bodies_[i], q);
    T[i] = {up.R * own.R, up.p + up.R * own.p};
  }
  T.erase(T.begin());
  return T;
}

/// X[i]: motion vectors parent -> i.
Reference::Matrices6 Reference::transforms(const Vector& q) const {
  Matrices6 X(bodies_.size());
  for (int i = 1; i <= nb(); ++i) {
    const Placement T = placement(bodies_[i], q);
    X[i] = spatial6::plucker(T.R, T.p);
  }
  return X;
}

Reference::Vectors6 Reference::velocities(const Matrices6& X, const Vector& qd) const {
  Vectors6 v(bodies_.size(), Vector6::Zero());
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    v[i] = X[i] * v[body.parent] + body.S * body.rates(qd);
  }
  return v;
}

// Table 5.1.  Gravity enters as an upward acceleration of the world.
Eigen::VectorXd Reference::rnea(const Vector& q, const Vector& qd, const Vector& qdd) const {
  const Matrices6 X = transforms(q);
  const Vectors6 v = velocities(X, qd);
  Vectors6 a(bodies_.size()), f(bodies_.size(), Vector6::Zero());
  a[0] << Eigen::Vector3d::Zero(), -gravity_;
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    const Vector6 v_J = body.S * body.rates(qd);
    a[i] = X[i] * a[body.parent] + body.S * body.rates(qdd) + crm(v[i]) * v_J;
    f[i] = body.I * a[i] + crf(v[i]) * (body.I * v[i]);
  }
  Vector tau = Vector::Zero(nv_);
  for (int i = nb(); i > 0; --i) {
    const Body& body = bodies_[i];
    tau.segment(body.at.v, body.S.cols()) += body.at.multiplier * (body.S.transpose() * f[i]);
    f[body.parent] += X[i].transpose() * f[i];
  }
  return tau;
}

Eigen::VectorXd Reference::gravity(const Vector& q) const {
  return rnea(q, Vector::Zero(nv_), Vector::Zero(nv_));
}

Eigen::VectorXd Reference::nle(const Vector& q, const Vector& v) const {
  return rnea(q, v, Vector::Zero(nv_));
}

// Table 6.2.  A follower's rows and columns are added to its leader's, times the multiplier: this
// is G^T H G with v_full = G v.
Eigen::MatrixXd Reference::crba(const Vector& q) const {
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
    Matrix F = Ic[i] * body.S;
    add(body, body, body.S.transpose() * F);
    for (int j = i; bodies_[j].parent > 0;) {
      F = X[j].transpose() * F;
      j = bodies_[j].parent;
      const Matrix block = F.transpose() * bodies_[j].S;
      add(body, bodies_[j], block);
      add(bodies_[j], body, block.transpose());
    }
  }
  return H;
}

Eigen::MatrixXd Reference::minv(const Vector& q) const {
  return crba(q).llt().solve(Matrix::Identity(nv_, nv_));
}

Eigen::VectorXd Reference::aba(const Vector& q, const Vector& v, const Vector& tau) const {
  if (!mimic_) return articulated_body(q, v, tau);
  return crba(q).llt().solve(tau - nle(q, v));
}

// Table 7.1.  A fixed joint has an empty S and passes everything on.
Reference::Articulated Reference::articulated_inertias(const Matrices6& X, const Vectors6& v,
                                                       const Vectors6& c, const Vector& tau) const {
  Articulated result{std::vector<Matrix>(bodies_.size()),
                     std::vector<Eigen::LLT<Matrix>>(bodies_.size()),
                     std::vector<Vector>(bodies_.size())};
  auto& [U, D, u] = result;
  Matrices6 IA(bodies_.size(), Matrix6::Zero());
  Vectors6 pA(bodies_.size(), Vector6::Zero());
  for (int i = 1; i <= nb(); ++i) {
    IA[i] = bodies_[i].I;
    pA[i] = crf(v[i]) * (bodies_[i].I * v[i]);
  }
  for (int i = nb(); i > 0; --i) {
    const Body& body = bodies_[i];
    Matrix6 Ia = IA[i];
    Vector6 pa = pA[i] + Ia * c[i];
    if (body.S.cols() > 0) {
      U[i] = IA[i] * body.S;
      D[i].compute(body.S.transpose() * U[i]);
      u[i] = tau.segment(body.at.v, body.S.cols()) - body.S.transpose() * pA[i];
      Ia -= U[i] * D[i].solve(U[i].transpose());
      pa = pA[i] + Ia * c[i] + U[i] * D[i].solve(u[i]);
    }
    IA[body.parent] += X[i].transpose() * Ia * X[i];
    pA[body.parent] += X[i].transpose() * pa;
  }
  return result;
}

Eigen::VectorXd Reference::articulated_body(const Vector& q, const Vector& qd,
                                            const Vector& tau) const {
  const Matrices6 X = transforms(q);
  const Vectors6 v = velocities(X, qd);
  Vectors6 a(bodies_.size()), c(bodies_.size());
  for (int i = 1; i <= nb(); ++i) c[i] = crm(v[i]) * (bodies_[i].S * bodies_[i].rates(qd));
  const auto [U, D, u] = articulated_inertias(X, v, c, tau);
  a[0] << Eigen::Vector3d::Zero(), -gravity_;
  Vector qdd(nv_);
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    a[i] = X[i] * a[body.parent] + c[i];
    if (body.S.cols() == 0) continue;
    const Vector own = D[i].solve(u[i] - U[i].transpose() * a[i]);
    qdd.segment(body.at.v, body.S.cols()) = own;
    a[i] += body.S * own;
  }
  return qdd;
}

double Reference::kinetic(const Vector& q, const Vector& qd) const {
  const Vectors6 v = velocities(transforms(q), qd);
  double T = 0;
  for (int i = 1; i <= nb(); ++i) T += v[i].dot(bodies_[i].I * v[i]) / 2;
  return T;
}

double Reference::potential(const Vector& q) const {
  const std::vector<Placement> T = fk(q);
  double V = 0;
  for (int i = 1; i <= nb(); ++i)
    V -= bodies_[i].m * gravity_.dot(T[i - 1].p + T[i - 1].R * bodies_[i].c);
  return V;
}

Eigen::VectorXd Reference::integrate(const Vector& q, const Vector& dv) const {
  Vector result = q;
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    if (body.joint.mimic) continue;
    const int n = arboc::nq(body.joint.type);
    result.segment(body.at.q, n) =
        integrate_joint(body.joint, q.segment(body.at.q, n), dv.segment(body.at.v, body.S.cols()));
  }
  return result;
}

}  // namespace arboc

#include "reference/reference.h"

#include "reference/axes.h"
#include "reference/eigen.h"

namespace arboc {

using spatial6::crf;
using spatial6::crm;

template <class S>
ReferenceOf<S>::ReferenceOf(const Model& model, const JointForces& forces)
    : forces_(forces), gravity_(to_eigen(model.gravity)) {
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
    const Eigen::Matrix3d R_tree = to_eigen(rotation(body.joint.origin));
    const Eigen::Vector3d p_tree = to_eigen(body.joint.origin.xyz);
    body.T_tree = {R_tree.cast<S>(), p_tree.cast<S>()};
    body.motion = motion_subspace(body.joint).template cast<S>();
    if (body.motion.cols() == 0) body.at = {0, 0, 1, 0};
    body.moves = bodies_[body.parent].moves || body.motion.cols() > 0;
    if (const auto& inertial = model.links[i - 1].inertial) {
      const Eigen::Matrix3d R = to_eigen(rotation(inertial->origin));
      const Eigen::Vector3d c = to_eigen(inertial->origin.xyz);
      const Eigen::Matrix3d Ic = R * to_eigen(inertial->inertia) * R.transpose();
      body.m = inertial->mass;
      body.c = c.cast<S>();
      body.I = spatial6::rigid_inertia<double>(body.m, c, Ic).template cast<S>();
    }
  }
}

template <class S>
VectorOf<S> ReferenceOf<S>::Body::positions(const Vector& q) const {
  const int n = arboc::nq(joint.type);
  return at.multiplier * q.segment(at.q, n) + Vector::Constant(n, at.offset);
}

template <class S>
PlacementOf<S> ReferenceOf<S>::placement(const Body& body, const Vector& q) const {
  return body.T_tree * joint_placement(body.joint, body.positions(q));
}

template <class S>
std::vector<PlacementOf<S>> ReferenceOf<S>::fk(const Vector& q) const {
  std::vector<PlacementOf<S>> T(bodies_.size());
  for (int i = 1; i <= nb(); ++i) T[i] = T[bodies_[i].parent] * placement(bodies_[i], q);
  T.erase(T.begin());
  return T;
}

template <class S>
auto ReferenceOf<S>::transforms(const Vector& q) const -> Matrices6 {
  Matrices6 X(bodies_.size());
  for (int i = 1; i <= nb(); ++i) {
    const PlacementOf<S> T = placement(bodies_[i], q);
    X[i] = spatial6::plucker(T.R, T.p);
  }
  return X;
}

template <class S>
auto ReferenceOf<S>::velocities(const Matrices6& X, const Vector& qd) const -> Vectors6 {
  Vectors6 v(bodies_.size(), Vector6::Zero());
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    v[i] = X[i] * v[body.parent] + body.motion * body.rates(qd);
  }
  return v;
}

template <class S>
auto ReferenceOf<S>::accelerations(const Matrices6& X, const Vectors6& velocity, const Vector& qd,
                                   const Vector& qdd, const Vector6& a0) const -> Vectors6 {
  Vectors6 a(bodies_.size(), a0);
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    const Vector6 v_J = body.motion * body.rates(qd);
    a[i] = X[i] * a[body.parent] + body.motion * body.rates(qdd) + crm(velocity[i]) * v_J;
  }
  return a;
}

template <class S>
auto ReferenceOf<S>::applied(const Vector& q, const Loads& loads) const -> Vectors6 {
  Vectors6 f(bodies_.size(), Vector6::Zero());
  if (loads.empty()) return f;
  const std::vector<PlacementOf<S>> T = fk(q);
  for (const LinkWrench& load : loads)
    f[load.link + 1] +=
        to_axes(T[load.link], load.axes).transpose() * load.wrench.template cast<S>();
  return f;
}

template <class S>
auto ReferenceOf<S>::rising() const -> Vector6 {
  Vector6 a;
  a << spatial6::Vec3<S>::Zero(), -gravity_.cast<S>();
  return a;
}

template <class S>
VectorOf<S> ReferenceOf<S>::passive(const Body& body, const Vector& q, const Vector& qd) const {
  const Joint& joint = body.joint;
  const Vector v = body.rates(qd);
  Vector force = Vector::Zero(v.size());
  if (forces_.damping) force += joint.damping * v;
  if (forces_.friction && joint.friction != 0) {
    const double slow = forces_.friction_velocity;
    for (int i = 0; i < v.size(); ++i)
      force[i] += joint.friction * v[i] / std::sqrt(v[i] * v[i] + slow * slow);
  }
  if (forces_.stiffness && arboc::nq(joint) == 1)
    force[0] += joint.stiffness * (body.positions(q)[0] - joint.neutral);
  return force;
}

// Table 5.1.  Gravity enters as an upward acceleration of the world.
template <class S>
VectorOf<S> ReferenceOf<S>::rnea(const Vector& q, const Vector& qd, const Vector& qdd,
                                 const Loads& loads) const {
  const Matrices6 X = transforms(q);
  const Vectors6 v = velocities(X, qd), a = accelerations(X, v, qd, qdd, rising());
  Vectors6 f = applied(q, loads);
  for (int i = 1; i <= nb(); ++i) {
    const Matrix6& I = bodies_[i].I;
    f[i] = I * a[i] + crf(v[i]) * (I * v[i]) - f[i];
  }
  Vector tau = Vector::Zero(nv_);
  for (int i = nb(); i > 0; --i) {
    const Body& body = bodies_[i];
    const Vector own = body.motion.transpose() * f[i] + passive(body, q, qd);
    tau.segment(body.at.v, body.motion.cols()) +=
        body.at.multiplier * (own + rotor(body) * body.rates(qdd));
    f[body.parent] += X[i].transpose() * f[i];
  }
  return tau;
}

template <class S>
VectorOf<S> ReferenceOf<S>::gravity(const Vector& q) const {
  return rnea(q, Vector::Zero(nv_), Vector::Zero(nv_));
}

template <class S>
VectorOf<S> ReferenceOf<S>::nle(const Vector& q, const Vector& v, const Loads& loads) const {
  return rnea(q, v, Vector::Zero(nv_), loads);
}

template <class S>
S ReferenceOf<S>::kinetic(const Vector& q, const Vector& qd) const {
  const Vectors6 v = velocities(transforms(q), qd);
  S T = 0;
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    const Vector rates = body.rates(qd);
    T += v[i].cwiseProduct(body.I * v[i]).sum() / 2.;
    T += rotor(body) * rates.cwiseProduct(rates).sum() / 2.;
  }
  return T;
}

template <class S>
S ReferenceOf<S>::potential(const Vector& q) const {
  const std::vector<PlacementOf<S>> T = fk(q);
  S V = 0;
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    const spatial6::Vec3<S> c = T[i - 1].p + T[i - 1].R * body.c;
    if (body.moves) V -= body.m * gravity_.cast<S>().cwiseProduct(c).sum();
    if (!forces_.stiffness || arboc::nq(body.joint) != 1) continue;
    const S stretch = body.positions(q)[0] - body.joint.neutral;
    V += body.joint.stiffness * stretch * stretch / 2.;
  }
  return V;
}

template <class S>
VectorOf<S> ReferenceOf<S>::integrate(const Vector& q, const Vector& dv) const {
  Vector result = q;
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    if (body.joint.mimic) continue;
    const int n = arboc::nq(body.joint.type);
    result.segment(body.at.q, n) = integrate_joint<S>(body.joint, q.segment(body.at.q, n),
                                                      dv.segment(body.at.v, body.motion.cols()));
  }
  return result;
}

template <class S>
VectorOf<S> ReferenceOf<S>::difference(const Vector& q0, const Vector& q1) const {
  Vector result(nv_);
  for (int i = 1; i <= nb(); ++i) {
    const Body& body = bodies_[i];
    if (body.joint.mimic) continue;
    const int n = arboc::nq(body.joint.type);
    result.segment(body.at.v, body.motion.cols()) =
        joint_difference<S>(body.joint, q0.segment(body.at.q, n), q1.segment(body.at.q, n));
  }
  return result;
}

template class ReferenceOf<double>;
template class ReferenceOf<Complex>;

}  // namespace arboc

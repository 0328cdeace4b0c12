#include "reference/momentum.h"

#include "reference/axes.h"

namespace arboc {
namespace {

using spatial6::crf;
using spatial6::Matrix6;
using spatial6::Vec3;
using spatial6::Vector6;

template <class S>
double mass(const ReferenceOf<S>& reference) {
  double sum = 0;
  for (const auto& body : reference.bodies())
    if (body.moves) sum += body.m;
  return sum;
}

/// Momenta and forces at the world's origin, linear first, become those about `c`.
template <class S>
Matrix6<S> about(const Vec3<S>& c) {
  Matrix6<S> X = Matrix6<S>::Identity();
  X.template bottomLeftCorner<3, 3>() = -spatial6::skew(c);
  return X;
}

/// Forces on a link at `T`, in its own frame and angular first, at the world's origin, linear
/// first.
template <class S>
Matrix6<S> force_to_world(const PlacementOf<S>& T) {
  Matrix6<S> X;
  X << spatial6::Mat3<S>::Zero(), T.R, T.R, spatial6::skew(T.p) * T.R;
  return X;
}

}  // namespace

double moving_mass(const Model& model) { return mass(Reference(model)); }

template <class S>
Vec3<S> com(const ReferenceOf<S>& reference, const VectorOf<S>& q) {
  const auto T = reference.fk(q);
  Vec3<S> moment = Vec3<S>::Zero();
  for (int i = 1; i <= reference.nb(); ++i) {
    const auto& body = reference.bodies()[i];
    if (body.moves) moment += body.m * (T[i - 1].p + T[i - 1].R * body.c);
  }
  return moment / mass(reference);
}

template <class S>
Vec3<S> com_velocity(const ReferenceOf<S>& reference, const VectorOf<S>& q, const VectorOf<S>& v) {
  const auto T = reference.fk(q);
  const auto velocity = reference.velocities(reference.transforms(q), v);
  Vec3<S> momentum = Vec3<S>::Zero();
  for (int i = 1; i <= reference.nb(); ++i) {
    const auto& body = reference.bodies()[i];
    const Vec3<S> w = velocity[i].template head<3>(), l = velocity[i].template tail<3>();
    if (body.moves) momentum += body.m * (T[i - 1].R * (l + spatial6::skew(w) * body.c));
  }
  return momentum / mass(reference);
}

template <class S>
Eigen::Matrix<S, 3, Eigen::Dynamic> com_jacobian(const ReferenceOf<S>& reference,
                                                 const VectorOf<S>& q) {
  const auto T = reference.fk(q);
  Eigen::Matrix<S, 3, Eigen::Dynamic> sum(3, reference.nv());
  sum.setZero();
  for (int i = 1; i <= reference.nb(); ++i) {
    const auto& body = reference.bodies()[i];
    if (!body.moves || body.m == 0) continue;
    const Matrix6XOf<S> J = frame_jacobian(reference, q, i - 1, Axes::kAligned);
    const Vec3<S> arm = T[i - 1].R * body.c;
    sum += body.m * (J.template topRows<3>() - spatial6::skew(arm) * J.template bottomRows<3>());
  }
  return sum / mass(reference);
}

template <class S>
CentroidalOf<S> centroidal(const ReferenceOf<S>& reference, const VectorOf<S>& q,
                           const VectorOf<S>& v, const VectorOf<S>& a) {
  const auto T = reference.fk(q);
  const auto X = reference.transforms(q);
  const auto velocity = reference.velocities(X, v);
  const Vector6<S> zero = Vector6<S>::Zero();
  const auto acceleration = reference.accelerations(X, velocity, v, a, zero);
  CentroidalOf<S> result{zero, Matrix6XOf<S>::Zero(6, reference.nv()), zero};
  std::vector<Matrix6<S>> Ic(X.size());
  for (int i = 0; i <= reference.nb(); ++i) Ic[i] = reference.bodies()[i].I;
  for (int i = reference.nb(); i > 0; --i) {
    const auto& body = reference.bodies()[i];
    const Matrix6<S> up = force_to_world(T[i - 1]);
    const Vector6<S> h = body.I * velocity[i];
    result.h += up * h;
    result.dh += up * (body.I * acceleration[i] + crf(velocity[i]) * h);
    result.A_G.middleCols(body.at.v, body.motion.cols()) +=
        body.at.multiplier * (up * (Ic[i] * body.motion));
    Ic[body.parent] += X[i].transpose() * Ic[i] * X[i];
  }
  // The centre of mass moves along the linear momentum, so its motion adds nothing to dh.
  const Matrix6<S> shift = about(com(reference, q));
  return {shift * result.h, shift * result.A_G, shift * result.dh};
}

#define ARBOC_INSTANTIATE(S)                                                                    \
  template Vec3<S> com(const ReferenceOf<S>&, const VectorOf<S>&);                              \
  template Vec3<S> com_velocity(const ReferenceOf<S>&, const VectorOf<S>&, const VectorOf<S>&); \
  template Eigen::Matrix<S, 3, Eigen::Dynamic> com_jacobian(const ReferenceOf<S>&,              \
                                                            const VectorOf<S>&);                \
  template CentroidalOf<S> centroidal(const ReferenceOf<S>&, const VectorOf<S>&,                \
                                      const VectorOf<S>&, const VectorOf<S>&);
ARBOC_INSTANTIATE(double)
ARBOC_INSTANTIATE(Complex)
#undef ARBOC_INSTANTIATE

}  // namespace arboc

#include "reference/frames.h"

#include "reference/axes.h"

namespace arboc {
namespace {

using spatial6::crm;
using spatial6::Matrix6;
using spatial6::Vector6;

/// The velocity of the link, in its own frame, relative to the axes in which a rate is taken.
template <class S>
Vector6<S> relative_velocity(const Vector6<S>& v, Axes axes) {
  Vector6<S> result = v;
  if (axes == Axes::kLocal) result.setZero();
  if (axes == Axes::kAligned) result.template tail<3>().setZero();
  return result;
}

/// f(body, X) for the link's body and all that carry it, X from the body's frame to the link's.
template <class S, class F>
void for_each_carrier(const ReferenceOf<S>& reference, const std::vector<Matrix6<S>>& X, int link,
                      const F& f) {
  Matrix6<S> down = Matrix6<S>::Identity();
  for (int i = link + 1; i > 0; i = reference.bodies()[i].parent) {
    f(i, down);
    down = down * X[i];
  }
}

}  // namespace

template <class S>
Vector6<S> frame_velocity(const ReferenceOf<S>& reference, const VectorOf<S>& q,
                          const VectorOf<S>& v, int link, Axes axes) {
  const auto velocity = reference.velocities(reference.transforms(q), v);
  return to_axes(reference.fk(q)[link], axes) * velocity[link + 1];
}

template <class S>
Vector6<S> frame_acceleration(const ReferenceOf<S>& reference, const VectorOf<S>& q,
                              const VectorOf<S>& v, const VectorOf<S>& a, int link, Axes axes) {
  const auto X = reference.transforms(q);
  const auto velocity = reference.velocities(X, v);
  const Vector6<S> zero = Vector6<S>::Zero(), own = velocity[link + 1];
  const Vector6<S> rate = reference.accelerations(X, velocity, v, a, zero)[link + 1] +
                          crm(relative_velocity(own, axes)) * own;
  return to_axes(reference.fk(q)[link], axes) * rate;
}

template <class S>
Matrix6XOf<S> frame_jacobian(const ReferenceOf<S>& reference, const VectorOf<S>& q, int link,
                             Axes axes) {
  Matrix6XOf<S> J = Matrix6XOf<S>::Zero(6, reference.nv());
  for_each_carrier(reference, reference.transforms(q), link, [&](int i, const Matrix6<S>& X) {
    const auto& body = reference.bodies()[i];
    J.middleCols(body.at.v, body.motion.cols()) += body.at.multiplier * (X * body.motion);
  });
  return to_axes(reference.fk(q)[link], axes) * J;
}

// A motion that is constant in a frame of velocity u changes by u x, [RBDA] (2.45).
template <class S>
Matrix6XOf<S> frame_jacobian_dot(const ReferenceOf<S>& reference, const VectorOf<S>& q,
                                 const VectorOf<S>& v, int link, Axes axes) {
  const auto X = reference.transforms(q);
  const auto velocity = reference.velocities(X, v);
  // Of the axes relative to the world, in the link's frame.
  const Vector6<S> moving = velocity[link + 1] - relative_velocity(velocity[link + 1], axes);
  Matrix6XOf<S> J = Matrix6XOf<S>::Zero(6, reference.nv());
  for_each_carrier(reference, X, link, [&](int i, const Matrix6<S>& down) {
    const auto& body = reference.bodies()[i];
    const MatrixOf<S> change = down * (crm(velocity[i]) * body.motion);
    J.middleCols(body.at.v, body.motion.cols()) +=
        body.at.multiplier * (change - crm(moving) * (down * body.motion));
  });
  return to_axes(reference.fk(q)[link], axes) * J;
}

template <class S>
Matrix6XOf<S> joint_jacobians(const ReferenceOf<S>& reference, const VectorOf<S>& q) {
  const auto T = reference.fk(q);
  Matrix6XOf<S> J = Matrix6XOf<S>::Zero(6, reference.nv());
  for (int i = 1; i <= reference.nb(); ++i) {
    const auto& body = reference.bodies()[i];
    J.middleCols(body.at.v, body.motion.cols()) +=
        body.at.multiplier * (to_axes(T[i - 1], Axes::kWorld) * body.motion);
  }
  return J;
}

#define ARBOC_INSTANTIATE(S)                                                                   \
  template Vector6<S> frame_velocity(const ReferenceOf<S>&, const VectorOf<S>&,                \
                                     const VectorOf<S>&, int, Axes);                           \
  template Vector6<S> frame_acceleration(const ReferenceOf<S>&, const VectorOf<S>&,            \
                                         const VectorOf<S>&, const VectorOf<S>&, int, Axes);   \
  template Matrix6XOf<S> frame_jacobian(const ReferenceOf<S>&, const VectorOf<S>&, int, Axes); \
  template Matrix6XOf<S> frame_jacobian_dot(const ReferenceOf<S>&, const VectorOf<S>&,         \
                                            const VectorOf<S>&, int, Axes);                    \
  template Matrix6XOf<S> joint_jacobians(const ReferenceOf<S>&, const VectorOf<S>&);
ARBOC_INSTANTIATE(double)
ARBOC_INSTANTIATE(Complex)
#undef ARBOC_INSTANTIATE

}  // namespace arboc

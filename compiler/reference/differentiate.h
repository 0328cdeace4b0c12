// Derivatives of what the reference engine computes, by complex step.
//
// An analytic function at x + i h d, h far below rounding, has h times its derivative along d for
// imaginary part: without a difference, so exact up to the rounding of the function itself [ST98].
// Configurations move in their tangent space, q (+) d as ReferenceOf::integrate has it.
//
// `f` is what to differentiate, on a ComplexReference:
//     [](const auto& r, const auto& x) { return r.rnea(x.q, x.v, x.a); }
// It returns a number, vector or matrix of Complex; matrices count column by column.
#pragma once
#include <vector>

#include "reference/reference.h"

namespace arboc {

/// A configuration, nq, and its motion and forces, nv each; what f does not read may be empty.
template <class S>
struct StateOf {
  VectorOf<S> q, v, a, tau;
};
using State = StateOf<double>;
using ComplexState = StateOf<Complex>;

enum class With { kQ, kV, kA, kTau };

/// What of two directions of q comes first.
enum class Second {
  kSymmetric,  ///< of f(q (+) d): both are entries of one d
  kIterated,   ///< of the first derivative at q (+) d: the other moves along axes turned by d
};

/// The state moved by `step` (nv) in q, v, a or tau.
template <class S>
StateOf<S> moved(const ReferenceOf<S>& reference, StateOf<S> state, With with,
                 const VectorOf<S>& step);
ComplexState complex(const State& state);

namespace complex_step {

constexpr double kStep = 1e-30;

inline Eigen::VectorXd imaginary(const Complex& y) {
  return Eigen::VectorXd::Constant(1, y.imag());
}
template <class D>
Eigen::VectorXd imaginary(const Eigen::MatrixBase<D>& y) {
  return MatrixOf<Complex>(y).reshaped().imag();
}

/// rad or m, of the differences between first derivatives; see differentiate.cc.
double difference_step(const ComplexReference& reference);

}  // namespace complex_step

/// The derivative of f along `direction` (nv; of q, v, a or tau).
template <class F>
Eigen::VectorXd derivative_along(const ComplexReference& reference, const F& f,
                                 const ComplexState& at, With with,
                                 const Eigen::VectorXd& direction) {
  const VectorOf<Complex> step = direction.cast<Complex>() * Complex(0, complex_step::kStep);
  return complex_step::imaginary(f(reference, moved(reference, at, with, step))) /
         complex_step::kStep;
}

/// Entries of f x nv.
template <class F>
Eigen::MatrixXd differentiate(const ComplexReference& reference, const F& f, const State& at,
                              With with) {
  const int n = reference.nv();
  Eigen::MatrixXd result;
  for (int j = 0; j < n; ++j) {
    const Eigen::VectorXd column =
        derivative_along(reference, f, complex(at), with, Eigen::VectorXd::Unit(n, j));
    if (j == 0) result.resize(column.size(), n);
    result.col(j) = column;
  }
  return result;
}

/// Per direction k of `second` the derivative of differentiate(f, first) along it, entries of f x
/// nv each: central differences of six points between complex steps, good for some 1e-12 of the
/// largest first derivative.
template <class F>
std::vector<Eigen::MatrixXd> differentiate_twice(const ComplexReference& reference, const F& f,
                                                 const State& at, With first, With second,
                                                 Second order = Second::kIterated) {
  const int n = reference.nv();
  const double h = complex_step::difference_step(reference);
  const bool together = order == Second::kSymmetric && first == second;
  const auto slope = [&](int j, int k, double t) -> Eigen::VectorXd {
    const VectorOf<Complex> outer = VectorOf<Complex>::Unit(n, k) * Complex(t);
    const VectorOf<Complex> inner = VectorOf<Complex>::Unit(n, j) * Complex(0, complex_step::kStep);
    const ComplexState start = complex(at);
    const ComplexState there =
        together ? moved<Complex>(reference, start, first, outer + inner)
                 : moved(reference, moved(reference, start, second, outer), first, inner);
    return complex_step::imaginary(f(reference, there)) / complex_step::kStep;
  };
  std::vector<Eigen::MatrixXd> result(n);
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j) {
      const auto odd = [&](int m) -> Eigen::VectorXd {
        return slope(j, k, m * h) - slope(j, k, -m * h);
      };
      const Eigen::VectorXd column = (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h);
      if (j == 0) result[k].resize(column.size(), n);
      result[k].col(j) = column;
    }
  return result;
}

/// Second derivatives of lambda^T f, f a vector: entry (j, k) along j of `first`, then k of
/// `second`.
template <class F>
Eigen::MatrixXd hessian(const ComplexReference& reference, const F& f,
                        const Eigen::VectorXd& lambda, const State& at, With first, With second,
                        Second order = Second::kSymmetric) {
  const auto weighted = [&](const ComplexReference& r, const ComplexState& x) -> Complex {
    return VectorOf<Complex>(f(r, x)).cwiseProduct(lambda.cast<Complex>()).sum();
  };
  const auto layers = differentiate_twice(reference, weighted, at, first, second, order);
  Eigen::MatrixXd result(reference.nv(), reference.nv());
  for (size_t k = 0; k < layers.size(); ++k)
    result.col(static_cast<Eigen::Index>(k)) = layers[k].row(0).transpose();
  return result;
}

}  // namespace arboc

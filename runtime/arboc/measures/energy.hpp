// Energy expenditure of a motion: five measures that human movement is said to minimise;
// [Astronaut] section 7.
//
// tau: torque of a joint (N m; of a sliding one the force, N), w: its rate, or where it says so the
// angular velocity of the segment along the joint's axis (rad/s).  Muscles that give way are three
// times as efficient as muscles that shorten, so negative work counts a third:
//   effort       sum c_i rho_i,  rho = |tau| where tau w >= 0, else |tau|/3                 N m
//   exchange     sum |change of E|, E = kinetic energy of all segments                         J
//   power        sum |tau_i (w_i - w_{i-1})|, w of the segments: generated or absorbed         W
//   transfer     sum p_i, p = tau w where that is >= 0, else |tau w|/3, w of the segments      W
//   jerk         sum |d qdd_i/dt|                                                    rad/s^3
// Each is a value at an instant; integrate over time with quadrature.hpp.  The smooth versions have
// derivatives for optimisers; their Hessians have entries only where one joint meets itself.
#ifndef ARBOC_MEASURES_ENERGY_HPP
#define ARBOC_MEASURES_ENERGY_HPP

#include <Eigen/Core>
#include <stdexcept>

#include "../motion/bspline.hpp"
#include "smooth.hpp"

namespace arboc {
inline namespace v1 {

/// What the measure of negative work is to that of positive.
constexpr double kNegativeWork = 1.0 / 3;

/// rho of one joint.
inline double joint_effort(double tau, double w) {
  return tau * w >= 0 ? std::fabs(tau) : kNegativeWork * std::fabs(tau);
}
/// |tau w| of one joint; w its own rate, which is the difference between the two segments'.
inline double joint_power(double tau, double w) { return std::fabs(tau * w); }
/// p of one joint; w of the segment that it moves.
inline double power_transfer(double tau, double w) {
  return tau * w >= 0 ? tau * w : -kNegativeWork * tau * w;
}

namespace detail {
template <class F>
double sum_of_pairs(const Eigen::VectorXd& a, const Eigen::VectorXd& b, F&& f) {
  if (a.size() != b.size()) throw std::invalid_argument("energy: sizes differ");
  double sum = 0;
  for (Eigen::Index i = 0; i < a.size(); ++i) sum += f(a[i], b[i], i);
  return sum;
}
}  // namespace detail

/// `weights` (c_i): one a joint; empty: all 1.
inline double effort(const Eigen::VectorXd& tau, const Eigen::VectorXd& w,
                     const Eigen::VectorXd& weights = {}) {
  if (weights.size() != 0 && weights.size() != tau.size())
    throw std::invalid_argument("energy: not one weight for each joint");
  return detail::sum_of_pairs(tau, w, [&](double x, double y, Eigen::Index i) {
    return (weights.size() == 0 ? 1 : weights[i]) * joint_effort(x, y);
  });
}
inline double power(const Eigen::VectorXd& tau, const Eigen::VectorXd& rate) {
  return detail::sum_of_pairs(tau, rate,
                              [](double x, double y, Eigen::Index) { return joint_power(x, y); });
}
inline double transfer(const Eigen::VectorXd& tau, const Eigen::VectorXd& segment_rate) {
  return detail::sum_of_pairs(
      tau, segment_rate, [](double x, double y, Eigen::Index) { return power_transfer(x, y); });
}
inline double jerk(const Eigen::VectorXd& jerks) { return jerks.cwiseAbs().sum(); }

/// TKE and RKE of a segment, J.  Its generated sum over all segments is energy().T.
struct SegmentEnergy {
  double translational, rotational;
};
/// mass (kg), velocity of the centre of mass (m/s), inertia about it (kg m^2) and angular velocity
/// (rad/s) along the same axes.
inline SegmentEnergy segment_energy(double mass, const Eigen::Vector3d& velocity,
                                    const Eigen::Matrix3d& inertia, const Eigen::Vector3d& w) {
  return {mass * velocity.squaredNorm() / 2, w.dot(inertia * w) / 2};
}
/// Sum of the changes of an energy over its samples in time, up and down, J.
inline double exchange(const Eigen::VectorXd& energies) {
  const Eigen::Index n = energies.size();
  return n < 2 ? 0 : (energies.tail(n - 1) - energies.head(n - 1)).cwiseAbs().sum();
}

/// Whether the jerk of curves in this basis means anything: null if it is continuous, otherwise
/// what to know, for a reader.
inline const char* jerk_warning(const BSplineBasis& basis) {
  if (basis.degree() < 3) return "the jerk of B-splines below degree 3 is zero between their knots";
  if (basis.continuous_derivatives() < 3)
    return "the jerk of these B-splines jumps at their knots (degree 4 and simple knots make it "
           "continuous)";
  return nullptr;
}

/// A function of (tau, w) and its derivatives.
template <class T>
struct Jet2 {
  T value, d_tau, d_w, d_tau_tau, d_tau_w, d_w_w;
};

/// How far smooth measures are rounded, as what counts as zero.
struct Smoothing {
  double torque = 1e-2;  ///< N m
  double power = 1e-2;   ///< W
  double jerk = 1e-2;    ///< rad/s^3
};

/// Between tau w = -power and power the measure goes from a third to all; at w = 0 it is 2/3.
template <class T>
Jet2<T> smooth_joint_effort(const T& tau, const T& w, const Smoothing& e = {}) {
  const Jet1<T> a = smooth_abs(tau, e.torque), h = smooth_step(T(tau * w), e.power);
  const T s = kNegativeWork + (1 - kNegativeWork) * h.value, s1 = (1 - kNegativeWork) * h.d,
          s2 = (1 - kNegativeWork) * h.dd;
  return {a.value * s,
          a.d * s + a.value * s1 * w,
          a.value * s1 * tau,
          a.dd * s + 2.0 * a.d * s1 * w + a.value * s2 * w * w,
          a.d * s1 * tau + a.value * (s2 * tau * w + s1),
          a.value * s2 * tau * tau};
}

namespace detail {
/// f(tau w) of f(x).
template <class T>
Jet2<T> of_product(const T& tau, const T& w, const Jet1<T>& f) {
  return {f.value, f.d * w, f.d * tau, f.dd * w * w, f.d + f.dd * tau * w, f.dd * tau * tau};
}
}  // namespace detail

template <class T>
Jet2<T> smooth_joint_power(const T& tau, const T& w, const Smoothing& e = {}) {
  return detail::of_product(tau, w, smooth_abs(T(tau * w), e.power));
}
/// p = |tau w| (1 + n)/2 + tau w (1 - n)/2, n = 1/3: convex in tau w, and a third of its size where
/// it is negative.
template <class T>
Jet2<T> smooth_power_transfer(const T& tau, const T& w, const Smoothing& e = {}) {
  constexpr double odd = (1 - kNegativeWork) / 2, even = (1 + kNegativeWork) / 2;
  const T x = tau * w;
  const Jet1<T> a = smooth_abs(x, e.power);
  return detail::of_product(tau, w,
                            Jet1<T>{odd * x + even * a.value, odd + even * a.d, even * a.dd});
}
template <class T>
Jet1<T> smooth_jerk(const T& jerk, const Smoothing& e = {}) {
  return smooth_abs(jerk, e.jerk);
}

/// A sum over joints, with what an optimiser needs: entry i of each vector is of joint i.
struct SmoothMeasure {
  double value = 0;
  Eigen::VectorXd d_tau, d_w, d_tau_tau, d_tau_w, d_w_w;
};
/// `measure(tau, w)` is one of the smooth functions above:
///   sum_over_joints(tau, w, [&](double t, double r) { return smooth_joint_effort(t, r, e); })
template <class F>
SmoothMeasure sum_over_joints(const Eigen::VectorXd& tau, const Eigen::VectorXd& w, F&& measure,
                              const Eigen::VectorXd& weights = {}) {
  const Eigen::Index n = tau.size();
  if (w.size() != n || (weights.size() != 0 && weights.size() != n))
    throw std::invalid_argument("energy: sizes differ");
  SmoothMeasure sum;
  for (Eigen::VectorXd* x : {&sum.d_tau, &sum.d_w, &sum.d_tau_tau, &sum.d_tau_w, &sum.d_w_w})
    x->resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double c = weights.size() == 0 ? 1 : weights[i];
    const Jet2<double> f = measure(tau[i], w[i]);
    sum.value += c * f.value;
    sum.d_tau[i] = c * f.d_tau;
    sum.d_w[i] = c * f.d_w;
    sum.d_tau_tau[i] = c * f.d_tau_tau;
    sum.d_tau_w[i] = c * f.d_tau_w;
    sum.d_w_w[i] = c * f.d_w_w;
  }
  return sum;
}

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_MEASURES_ENERGY_HPP

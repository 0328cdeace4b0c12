// Joint torques relative to their limits, and norms of them; [Thesis] (5.3)-(5.7).
//
// L < 0 < U are the limits of a joint.  Its normalised torque
//   n(tau) = tau/U where tau >= 0, tau/L where tau < 0                                       (5.3)
// is 1 at either limit and has a kink at 0 (5.4); n^2 has none: its slope is continuous (5.5), and
// only its second derivative jumps from 2/L^2 to 2/U^2.  Two measures of all joints, or of all
// joints at many instants:
//   sum n_i^2                                                                          (5.6) (6.3)
//   F = { sum (n_i^2 + 1)^p }^(1/p)                                                    (5.7) (6.4)
// F tends to 1 + max n^2 as p grows: 1 + max n^2 <= F <= (1 + max n^2) m^(1/p) of m terms.  It is
// computed from ratios to the largest term, so that no power overflows.  The exact least maximum is
// had without powers: minimise s subject to L_i s <= tau_i <= U_i s.
#ifndef ARBOC_MEASURES_TORQUE_HPP
#define ARBOC_MEASURES_TORQUE_HPP

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <string>

#include "smooth.hpp"

namespace arboc {
inline namespace v1 {

class TorqueLimits {
 public:
  /// One a joint, N m; infinite ones make its torque count nothing.
  TorqueLimits(Eigen::VectorXd lower, Eigen::VectorXd upper)
      : lower_(std::move(lower)), upper_(std::move(upper)) {
    if (lower_.size() != upper_.size())
      throw std::invalid_argument("torque limits: as many lower as upper ones");
    for (Eigen::Index i = 0; i < lower_.size(); ++i)
      if (!(lower_[i] < 0 && 0 < upper_[i]))
        throw std::invalid_argument("torque limits: entry " + std::to_string(i) +
                                    " is not below 0 and above 0");
  }

  Eigen::Index size() const { return lower_.size(); }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }
  /// The same at many instants: limits of a vector of torques, instant after instant.
  TorqueLimits at_instants(int count) const {
    return TorqueLimits(lower_.replicate(count, 1), upper_.replicate(count, 1));
  }

  /// The limit on that side to which the torque pulls.
  double towards(double tau, Eigen::Index i) const { return tau < 0 ? lower_[i] : upper_[i]; }

 private:
  Eigen::VectorXd lower_, upper_;
};

/// n, not negative; 1 at a limit.
inline double normalised_torque(double tau, double lower, double upper) {
  return tau / (tau < 0 ? lower : upper);
}
inline Eigen::VectorXd normalised_torque(const Eigen::VectorXd& tau, const TorqueLimits& limits) {
  if (tau.size() != limits.size()) throw std::invalid_argument("torque limits: sizes differ");
  Eigen::VectorXd n(tau.size());
  for (Eigen::Index i = 0; i < n.size(); ++i) n[i] = tau[i] / limits.towards(tau[i], i);
  return n;
}

/// n^2; at 0 the second derivative is that of the positive side.
inline Jet1<double> normalised_torque_squared(double tau, double lower, double upper) {
  const double limit = tau < 0 ? lower : upper, n = tau / limit;
  return {n * n, 2 * n / limit, 2 / (limit * limit)};
}

/// A measure of torques: its Hessian is diag(diagonal) - rank_one rank_one^T.
struct TorqueMeasure {
  double value = 0;
  Eigen::VectorXd gradient;
  Eigen::VectorXd diagonal;
  Eigen::VectorXd rank_one;  ///< zero where terms do not meet

  Eigen::MatrixXd hessian() const {
    return Eigen::MatrixXd(diagonal.asDiagonal()) - rank_one * rank_one.transpose();
  }
};

/// (5.6).
inline TorqueMeasure normalised_torque_sum(const Eigen::VectorXd& tau, const TorqueLimits& limits) {
  if (tau.size() != limits.size()) throw std::invalid_argument("torque limits: sizes differ");
  const Eigen::Index m = tau.size();
  TorqueMeasure sum{0, Eigen::VectorXd(m), Eigen::VectorXd(m), Eigen::VectorXd::Zero(m)};
  for (Eigen::Index i = 0; i < m; ++i) {
    const Jet1<double> square =
        normalised_torque_squared(tau[i], limits.lower()[i], limits.upper()[i]);
    sum.value += square.value;
    sum.gradient[i] = square.d;
    sum.diagonal[i] = square.dd;
  }
  return sum;
}

/// (5.7), p >= 1.  With y = n^2 + 1 and F its p-norm,
///   dF/dy_i = (y_i/F)^(p-1),   d2F/dy_i dy_j = (p-1)/F { [i = j] (y_i/F)^(p-2) - dF/dy_i dF/dy_j
///   }.
inline TorqueMeasure normalised_torque_norm(const Eigen::VectorXd& tau, const TorqueLimits& limits,
                                            double p = 100) {
  if (!(p >= 1) || !std::isfinite(p))
    throw std::invalid_argument("torque norm: p is a finite number of at least 1");
  TorqueMeasure norm = normalised_torque_sum(tau, limits);
  const Eigen::Index m = tau.size();
  Eigen::ArrayXd y(m);
  for (Eigen::Index i = 0; i < m; ++i)
    y[i] = 1 + normalised_torque_squared(tau[i], limits.lower()[i], limits.upper()[i]).value;
  const double largest = m > 0 ? y.maxCoeff() : 0;
  const double F = m > 0 ? largest * std::pow((y / largest).pow(p).sum(), 1 / p) : 0;
  norm.value = F;
  for (Eigen::Index i = 0; i < m; ++i) {
    const double slope = norm.gradient[i], ratio = y[i] / F, g = std::pow(ratio, p - 1);
    norm.gradient[i] = g * slope;
    norm.diagonal[i] = g * norm.diagonal[i] + (p - 1) / y[i] * g * slope * slope;
    norm.rank_one[i] = std::sqrt((p - 1) / F) * g * slope;
  }
  return norm;
}

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_MEASURES_TORQUE_HPP

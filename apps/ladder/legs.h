// Legs that float: nothing drives hips and knees but their own stiffness and damping.
//
// Arms move as planned, so that the legs' accelerations follow from their rows of the equation of
// motion:  M_ll qdd_l = -k (q_l - q_l(0)) - c qd_l - tau_l(q, qd, (qdd_arms, 0)).
#pragma once
#include "plan.h"

namespace ladder {

class FloatingLegs {
 public:
  explicit FloatingLegs(const Plan& plan);

  /// The planned state at t with the legs where they have come to; times do not fall from call to
  /// call.
  State at(double t);
  /// Largest |kinetic energy - work of the joints| so far, J.
  double balance() const { return balance_; }

 private:
  using Legs = Eigen::Matrix<double, 7, 1>;  ///< angles, rates, work of all joints
  struct Rate {
    Legs of;
    State state;
  };

  Rate rate(const Period& p, double t, const Legs& legs);
  void advance(const Period& p, double to);

  const Plan& plan_;
  Passive passive_;
  std::size_t period_ = 0;
  double t_ = 0, balance_ = 0;
  Legs legs_ = Legs::Zero(), rest_ = Legs::Zero();
  Vector q_, v_, a_, tau_, column_;
};

}  // namespace ladder

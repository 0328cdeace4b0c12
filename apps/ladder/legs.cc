#include "legs.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace ladder {
namespace {

constexpr double kLongest = 1.5e-3;  ///< s, of a Runge-Kutta step: energy to 1e-9 J

}  // namespace

FloatingLegs::FloatingLegs(const Plan& plan) : plan_(plan), passive_(*plan.task.floating) {
  legs_.head<3>() = plan.periods[0].first.q.tail<3>();
  rest_ = legs_;
}

FloatingLegs::Rate FloatingLegs::rate(const Period& p, double t, const Legs& legs) {
  const Tree& tree = ladder::tree(p.held);
  Rate out{{}, p.at(t)};
  State& s = out.state;
  s.q.tail<3>() = legs.head<3>();
  s.v.tail<3>() = legs.segment<3>(3);
  s.a.tail<3>().setZero();
  q_ = tree.own(s.q), v_ = tree.own(s.v), a_ = tree.own(s.a);
  tree.rnea(q_, v_, a_, tau_);
  Eigen::Matrix3d M;
  Vector3 tau;
  const Vector rest = Vector::Zero(kJoints);
  for (int j = 0; j < 3; ++j) {
    const auto at = [&](int k) { return tree.index[static_cast<std::size_t>(kArms + k)]; };
    tree.rnea(q_, rest, Vector::Unit(kJoints, at(j)), column_);
    for (int i = 0; i < 3; ++i) M(i, j) = column_[at(i)];
    tau[j] = tau_[at(j)];
  }
  const Vector3 passive =
      -passive_.stiffness * (legs - rest_).head<3>() - passive_.damping * legs.segment<3>(3);
  s.a.tail<3>() = M.llt().solve(passive - tau);
  a_ = tree.own(s.a);
  tree.rnea(q_, v_, a_, tau_);
  out.of << legs.segment<3>(3), s.a.tail<3>(), tau_.dot(v_);
  return out;
}

void FloatingLegs::advance(const Period& p, double to) {
  const int steps = static_cast<int>(std::ceil((to - t_) / kLongest - 1e-9));
  const double h = steps > 0 ? (to - t_) / steps : 0, from = t_;
  for (int k = 0; k < steps; ++k) {
    const double t = from + k * h;
    const Legs a = rate(p, t, legs_).of, b = rate(p, t + h / 2, legs_ + h / 2 * a).of,
               c = rate(p, t + h / 2, legs_ + h / 2 * b).of, d = rate(p, t + h, legs_ + h * c).of;
    legs_ += h / 6 * (a + 2 * b + 2 * c + d);
  }
  t_ = to;
}

State FloatingLegs::at(double t) {
  while (period_ + 1 < plan_.periods.size() && plan_.periods[period_ + 1].begin <= t) {
    advance(plan_.periods[period_], plan_.periods[period_].end);
    ++period_;
  }
  const Period& p = plan_.periods[period_];
  advance(p, t);
  const State s = rate(p, t, legs_).state;
  balance_ = std::max(balance_, std::fabs(ladder::tree(p.held).kinetic_energy(q_, v_) - legs_[6]));
  return s;
}

}  // namespace ladder

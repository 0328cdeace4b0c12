#include "afloat.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace self_orientation {
namespace {

/// [x, y] of twists, linear part first.
Vector6 bracket(const Vector6& x, const Vector6& y) {
  const Eigen::Vector3d l = x.head<3>(), w = x.tail<3>(), m = y.head<3>(), u = y.tail<3>();
  Vector6 out;
  out << w.cross(m) + l.cross(u), w.cross(u);
  return out;
}

}  // namespace

Vector6 base_velocity(const Model& model, const Vector& q, const Vector& qd) {
  Vector v = Vector::Zero(model.nv);
  v.tail(qd.size()) = qd;
  const Momentum still = model.momentum(q, v, Vector::Zero(model.nv));
  return -still.A_G.leftCols<6>().partialPivLu().solve(still.h);
}

BaseMotion base_motion(const Model& model, const Vector& q, const Vector& qd, const Vector& qdd) {
  Vector v(model.nv), a = Vector::Zero(model.nv);
  BaseMotion base;
  base.velocity = base_velocity(model, q, qd);
  v << base.velocity, qd;
  a.tail(qdd.size()) = qdd;
  const Momentum m = model.momentum(q, v, a);
  base.acceleration = -m.A_G.leftCols<6>().partialPivLu().solve(m.dh);
  return base;
}

// [Magnus] section 5.4, with brackets of the other sign: T' = T A instead of Y' = A Y.
Vector6 magnus(const Model& model, const Manoeuvre& manoeuvre, std::size_t step, double t0,
               double t1) {
  const double h = t1 - t0, middle = (t0 + t1) / 2, offset = std::sqrt(15.0) / 10 * h;
  const auto velocity = [&](double t) {
    const auto joints = manoeuvre.in_step(step, t);
    return base_velocity(model, model.at_origin(joints.position), joints.velocity);
  };
  const Vector6 A1 = velocity(middle - offset), A2 = velocity(middle),
                A3 = velocity(middle + offset);
  const Vector6 a1 = h * A2, a2 = std::sqrt(15.0) / 3 * h * (A3 - A1),
                a3 = 10.0 / 3 * h * (A3 - 2 * A2 + A1);
  const Vector6 C1 = -bracket(a1, a2), C2 = bracket(a1, 2 * a3 + C1) / 60;
  return a1 + a3 / 12 - bracket(-20 * a1 - a3 + C1, a2 + C2) / 240;
}

Trajectory simulate(const Model& model, const Manoeuvre& manoeuvre, double rate) {
  const int frames = static_cast<int>(std::ceil(manoeuvre.duration() * rate - 1e-9)) + 1;
  const std::vector<double>& ends = manoeuvre.ends();
  Trajectory out;
  Vector base = Vector::Zero(7);
  base[6] = 1;
  std::size_t step = 0;
  double t = 0;
  const auto advance = [&](double to) {
    if (!(to > t)) return;
    Vector q = model.at_origin(Vector::Zero(model.nv - 6)), move = Vector::Zero(model.nv);
    q.head<7>() = base;
    move.head<6>() = magnus(model, manoeuvre, step, t, to);
    base = model.integrate(q, move).head<7>();
    t = to;
  };
  for (int k = 0; k < frames; ++k) {
    const double at = std::min(k / rate, manoeuvre.duration());
    while (step + 2 < ends.size() && ends[step + 1] <= at) {
      advance(ends[step + 1]);
      ++step;
    }
    advance(at);
    const auto joints = manoeuvre.in_step(step, at);
    Vector q = model.at_origin(joints.position), v(model.nv), a(model.nv);
    q.head<7>() = base;
    const BaseMotion b = base_motion(model, q, joints.velocity, joints.acceleration);
    v << b.velocity, joints.velocity;
    a << b.acceleration, joints.acceleration;
    out.times.push_back(at);
    out.q.push_back(q);
    out.v.push_back(v);
    out.a.push_back(a);
  }
  return out;
}

Eigen::Matrix3d final_turn(const Model& model, const Manoeuvre& manoeuvre, int intervals) {
  const std::vector<double>& ends = manoeuvre.ends();
  Vector q = model.at_origin(manoeuvre(0).position), move = Vector::Zero(model.nv);
  const Eigen::Matrix3d start = orientation(model, q);
  for (std::size_t step = 0; step + 1 < ends.size(); ++step) {
    const double h = (ends[step + 1] - ends[step]) / intervals;
    for (int k = 0; k < intervals; ++k) {
      move.head<6>() = magnus(model, manoeuvre, step, ends[step] + k * h, ends[step] + (k + 1) * h);
      q = model.integrate(q, move);
    }
  }
  return start.transpose() * orientation(model, q);
}

Eigen::Matrix3d orientation(const Model& model, const Vector& q) {
  const std::vector<double> at = model.fk(q);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(at.data());
}

Heading heading(const Eigen::Matrix3d& R, int up) {
  // R = turn * tilt with an axis of the tilt that lies across `up`.
  const Eigen::Quaterniond r(R);
  const double turn = 2 * std::atan2(r.coeffs()[up], r.w());
  return {std::remainder(turn, 2 * 3.14159265358979323846),
          std::acos(std::clamp(R(up, up), -1.0, 1.0))};
}

}  // namespace self_orientation

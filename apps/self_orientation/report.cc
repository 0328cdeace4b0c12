#include "report.h"

#include <algorithm>
#include <arboc/measures/energy.hpp>
#include <chrono>
#include <cmath>

#include "paper.h"

namespace self_orientation {
namespace {

using Clock = std::chrono::steady_clock;

void momentum(const Model& model, Result& r) {
  const Trajectory& t = r.trajectory;
  const Eigen::Vector3d com = model.com(t.q[0]);
  double largest = 0, scale = 0;
  for (std::size_t k = 0; k < t.times.size(); ++k) {
    Vector joints = t.v[k];
    joints.head<6>().setZero();
    const Momentum m = model.momentum(t.q[k], t.v[k], t.a[k]);
    largest = std::max(largest, m.h.norm());
    scale = std::max(scale, (m.A_G * joints).norm());
    r.com_drift = std::max(r.com_drift, (model.com(t.q[k]) - com).norm());
  }
  r.momentum_drift = scale > 0 ? largest / scale : 0;
}

void torques(const Model& model, Result& r) {
  const Trajectory& t = r.trajectory;
  const auto frames = static_cast<Eigen::Index>(t.times.size());
  const Eigen::Index joints = model.nv - 6;
  r.torques.resize(frames, joints);
  r.effort.resize(frames);
  for (const std::string& name : model.joints) r.peaks.push_back({name, 0, 0});
  for (Eigen::Index k = 0; k < frames; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vector tau = model.rnea(t.q[i], t.v[i], t.a[i]);
    r.base_residual = std::max(r.base_residual, tau.head<6>().cwiseAbs().maxCoeff());
    r.torques.row(k) = tau.tail(joints).transpose();
    r.effort[k] = arboc::effort(tau.tail(joints), t.v[i].tail(joints));
    for (Eigen::Index j = 0; j < joints; ++j) {
      Peak& peak = r.peaks[static_cast<std::size_t>(j)];
      if (std::fabs(tau[6 + j]) > std::fabs(peak.torque))
        peak = {peak.joint, tau[6 + j], t.times[i]};
    }
  }
}

/// Integrals by trapezoids between frames; of jerk the sum of changes of accelerations.
void energy(const Model& model, Result& r) {
  const Trajectory& t = r.trajectory;
  const Eigen::Index joints = model.nv - 6;
  double effort = 0, power = 0, transfer = 0, jerk = 0, exchange = 0, before = 0;
  for (std::size_t k = 0; k < t.times.size(); ++k) {
    const Energy E = model.energy(t.q[k], t.v[k]);
    const Vector tau = r.torques.row(static_cast<Eigen::Index>(k)).transpose();
    const Vector rate = t.v[k].tail(joints);
    const double rate_of_change = E.by_q.dot(t.v[k]) + E.by_v.dot(t.a[k]);
    r.power_balance = std::max(r.power_balance, std::fabs(rate_of_change - tau.dot(rate)));
    const double weight = ((k > 0 ? t.times[k] - t.times[k - 1] : 0) +
                           (k + 1 < t.times.size() ? t.times[k + 1] - t.times[k] : 0)) /
                          2;  // trapezoids
    effort += weight * r.effort[static_cast<Eigen::Index>(k)];
    power += weight * arboc::power(tau, rate);
    transfer += weight * arboc::transfer(tau, model.segment_rates(t.q[k], t.v[k]));
    if (k > 0) exchange += std::fabs(E.T - before);
    before = E.T;
    if (k > 0) jerk += (t.a[k].tail(joints) - t.a[k - 1].tail(joints)).cwiseAbs().sum();
  }
  r.energy = {{"effort", effort},
              {"exchange", exchange},
              {"power", power},
              {"transfer", transfer},
              {"jerk", jerk}};
}

void paper(const Model& model, Result& r) {
  if (!model.paper) return;
  const ThreeBodies bodies = three_bodies(model);
  const Trajectory& t = r.trajectory;
  PaperDifference d;
  for (std::size_t k = 0; k < t.times.size(); ++k) {
    const PaperMotion m = paper_motion(bodies, t.q[k], t.v[k], t.a[k]);
    const Vector tau = r.torques.row(static_cast<Eigen::Index>(k)).transpose();
    const auto most = [](double& so_far, const Vector6& x) {
      so_far = std::max(so_far, x.cwiseAbs().maxCoeff());
    };
    most(d.velocity, m.v0 - t.v[k].head<6>());
    most(d.acceleration, m.a0 - t.a[k].head<6>());
    most(d.torque, m.torques - tau);
    most(d.momentum_rate, m.wrenches);
  }
  r.paper = d;
}

}  // namespace

Result report(const Model& model, const Task& task) {
  const Manoeuvre manoeuvre(task, model);
  Result r;
  const auto begin = Clock::now();
  r.trajectory = simulate(model, manoeuvre, task.rate);
  torques(model, r);
  r.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  const Trajectory& t = r.trajectory;
  const Heading h = heading(
      orientation(model, t.q.front()).transpose() * orientation(model, t.q.back()), model.up);
  r.heading = h.turn;
  r.tilt = h.tilt;
  r.closure = (t.q.back() - t.q.front()).tail(model.nq - 7).cwiseAbs().maxCoeff();
  momentum(model, r);
  energy(model, r);
  paper(model, r);
  return r;
}

}  // namespace self_orientation

#include "report.h"

#include <algorithm>
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

study::Effort torques(const Model& model, Result& r) {
  const Trajectory& t = r.trajectory;
  const Eigen::Index joints = model.nv - 6;
  study::Effort out(t.times.size(), model.joints.size());
  out.times = t.times;
  for (std::size_t i = 0; i < t.times.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Vector tau = model.rnea(t.q[i], t.v[i], t.a[i]);
    r.base_residual = std::max(r.base_residual, tau.head<6>().cwiseAbs().maxCoeff());
    out.torques.row(k) = tau.tail(joints).transpose();
    out.rates.row(k) = t.v[i].tail(joints).transpose();
    out.accelerations.row(k) = t.a[i].tail(joints).transpose();
  }
  return out;
}

void energy(const Model& model, study::Effort& effort, Result& r) {
  const Trajectory& t = r.trajectory;
  for (std::size_t i = 0; i < t.times.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const Energy E = model.energy(t.q[i], t.v[i]);
    effort.energies[k] = E.T;
    effort.segment_rates.row(k) = model.segment_rates(t.q[i], t.v[i]).transpose();
    const double rate_of_change = E.by_q.dot(t.v[i]) + E.by_v.dot(t.a[i]);
    r.power_balance =
        std::max(r.power_balance,
                 std::fabs(rate_of_change - effort.torques.row(k).dot(effort.rates.row(k))));
  }
  r.energy = study::expenditure(effort);
  r.peaks = study::peaks(model.joints, effort);
  r.weighted = study::weighted_torques(effort);
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
  study::Effort effort = torques(model, r);
  r.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  const Trajectory& t = r.trajectory;
  const Heading h = heading(
      orientation(model, t.q.front()).transpose() * orientation(model, t.q.back()), model.up);
  r.heading = h.turn;
  r.tilt = h.tilt;
  r.closure = (t.q.back() - t.q.front()).tail(model.nq - 7).cwiseAbs().maxCoeff();
  momentum(model, r);
  energy(model, effort, r);
  r.torques = effort.torques;
  paper(model, r);
  return r;
}

}  // namespace self_orientation

#include "sample.h"

#include <posture/build.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <arboc/measures/torque.hpp>
#include <cmath>
#include <set>

namespace motion {
namespace {

using namespace arboc::nlp;
using Eigen::VectorXd;

/// One row an instant as functions take them.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Loads as the dynamics take them: force and moment about the frame's origin, world axes.
void add_wrench(const Robot& robot, const std::string& frame, const Vector3& point,
                const double* placements, const Vector3& f, const Vector3& n, double* wrenches) {
  const Vector3 arm = Placement(placements + 12 * robot.frame(frame)).R * point;
  double* at = wrenches + 6 * robot.load(frame);
  Eigen::Map<Vector3> force(at), moment(at + 3);
  force += f;
  moment += n + arm.cross(f);
}

/// Forces and moments of contacts along the world's axes.
VectorXd in_world(const Task& task, const Robot& robot, const VectorXd& own,
                  const double* placements) {
  VectorXd world = own;
  const std::vector<Contact>& contacts = task.start.posture.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!contacts[c].own_axes) continue;
    const Eigen::Matrix3d R = Placement(placements + 12 * robot.frame(contacts[c].frame)).R;
    const auto at = static_cast<Eigen::Index>(6 * c);
    world.segment<3>(at) = R * own.segment<3>(at);
    world.segment<3>(at + 3) = R * own.segment<3>(at + 3);
  }
  return world;
}

/// Reactions along the contacts' axes, and loads, into wrenches of the dynamics; reactions along
/// the world's axes.
VectorXd push(const Task& task, const Robot& robot, const VectorXd& reactions,
              const double* placements, double* wrenches) {
  const VectorXd R = in_world(task, robot, reactions, placements);
  const std::vector<Contact>& contacts = task.start.posture.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    add_wrench(robot, contacts[c].frame, contacts[c].point, placements,
               R.segment<3>(static_cast<Eigen::Index>(6 * c)),
               R.segment<3>(static_cast<Eigen::Index>(6 * c + 3)), wrenches);
  for (const Load& load : task.start.posture.loads)
    add_wrench(robot, load.frame, load.point, placements, load.force, Vector3::Zero(), wrenches);
  return R;
}

}  // namespace

Samples sample(const Task& task, const Model& model, const Motion& motion, int count) {
  const Robot& robot = model.robot;
  const auto n = static_cast<Eigen::Index>(robot.size());
  Samples s;
  s.t = VectorXd::LinSpaced(count, motion.q.basis().begin(), motion.q.basis().end());
  s.q.resize(count, n);
  s.v.resize(count, n);
  s.a.resize(count, n);
  s.reactions.resize(count, motion.reactions.points().rows());
  for (Eigen::Index k = 0; k < count; ++k) {
    s.q.row(k) = motion.q(s.t[k]).transpose();
    s.v.row(k) = motion.q(s.t[k], 1).transpose();
    s.a.row(k) = motion.q(s.t[k], 2).transpose();
  }
  const Rows q = s.q;
  Rows placements(count, robot.placements->outputs()), tau(count, n);
  robot.placements->values(count, q.data(), placements.data());
  Rows inputs = Rows::Zero(count, robot.dynamics->inputs());
  inputs.leftCols(3 * n) << s.q, s.v, s.a;
  for (Eigen::Index k = 0; k < count; ++k)
    s.reactions.row(k) = push(task, robot, motion.reactions(s.t[k]), placements.row(k).data(),
                              inputs.row(k).data() + 3 * n)
                             .transpose();
  robot.dynamics->values(count, inputs.data(), tau.data());
  s.tau = tau;
  s.placements = placements;
  return s;
}

double largest_normalised(const Task& task, const Model& model, const State& state) {
  const Robot& robot = model.robot;
  const Eigen::Index n = state.q.size();
  VectorXd placements(robot.placements->outputs()), tau(n);
  robot.placements->values(1, state.q.data(), placements.data());
  VectorXd inputs = VectorXd::Zero(robot.dynamics->inputs());
  inputs.head(3 * n) << state.q, state.v, state.a;
  push(task, robot, state.reactions, placements.data(), inputs.data() + 3 * n);
  robot.dynamics->values(1, inputs.data(), tau.data());
  double largest = 0;
  for (std::size_t i = 0; i < model.passive.size(); ++i)
    if (!model.passive[i] && std::isfinite(robot.tau_upper[i]))
      largest = std::max(largest, arboc::normalised_torque(tau[static_cast<Eigen::Index>(i)],
                                                           robot.tau_lower[i], robot.tau_upper[i]));
  return largest;
}

std::vector<double> torque_peaks(const Model& model, const Samples& s, double above) {
  const Robot& robot = model.robot;
  std::set<Eigen::Index> found;
  for (std::size_t i = 0; i < model.passive.size(); ++i) {
    if (model.passive[i] || !std::isfinite(robot.tau_upper[i])) continue;
    const VectorXd n = s.tau.col(static_cast<Eigen::Index>(i)).unaryExpr([&](double tau) {
      return arboc::normalised_torque(tau, robot.tau_lower[i], robot.tau_upper[i]);
    });
    for (Eigen::Index k = 1; k + 1 < n.size(); ++k)
      if (n[k] > above && n[k] >= n[k - 1] && n[k] >= n[k + 1]) found.insert(k);
  }
  std::vector<double> instants;
  for (const Eigen::Index k : found) instants.push_back(s.t[k]);
  return instants;
}

std::vector<bool> translations(const Model& model) {
  const Robot& robot = model.robot;
  const auto n = static_cast<std::size_t>(robot.size());
  std::vector<double> q(n, 0), here(static_cast<std::size_t>(robot.placements->outputs())), there;
  robot.placements->values(1, q.data(), here.data());
  std::vector<bool> out(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    q[i] = 1;
    there = here;
    robot.placements->values(1, q.data(), there.data());
    q[i] = 0;
    double turned = 0, moved = 0;
    for (std::size_t k = 0; k < here.size(); ++k) {
      double& most = k % 12 < 9 ? turned : moved;
      most = std::max(most, std::fabs(there[k] - here[k]));
    }
    out[i] = turned < 1e-9 && moved > 1e-9;
  }
  return out;
}

std::map<std::string, double> measures(const Task& task, const Model& model, const Motion& motion,
                                       const Samples& s) {
  const Robot& robot = model.robot;
  const std::vector<double> relaxed = posture::relaxed_of(task.start.posture, model);
  std::map<std::string, double> out;
  for (Eigen::Index k = 0; k < s.t.size(); ++k) {
    // The trapezoidal rule.
    const double w = (k == 0 || k == s.t.size() - 1 ? 0.5 : 1.0) / (double(s.t.size()) - 1);
    for (std::size_t i = 0; i < relaxed.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      out["acceleration"] += w * s.a(k, at) * s.a(k, at);
      if (model.passive[i]) continue;
      const double off = s.q(k, at) - relaxed[i], tau = s.tau(k, at);
      out["displacement"] += w * off * off;
      out["torque"] += w * tau * tau;
      out["power"] += w * std::fabs(tau * s.v(k, at));
      if (!std::isfinite(robot.tau_upper[i])) continue;
      const double n = arboc::normalised_torque(tau, robot.tau_lower[i], robot.tau_upper[i]);
      out["normalised"] += w * n * n;
      out["maximum"] = std::max(out["maximum"], n);
    }
  }
  const Eigen::MatrixXd& P = motion.q.points();
  const Eigen::MatrixXd G = arboc::gram_matrix(motion.q.basis(), 3, 3);
  out["jerk"] = (P * G).cwiseProduct(P).sum() / task.duration;
  out["smoothness"] = out["jerk"] * std::pow(task.duration, 6);
  return out;
}

}  // namespace motion

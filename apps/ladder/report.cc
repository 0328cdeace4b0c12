#include "report.h"

#include <algorithm>
#include <arboc/motion/quadrature.hpp>
#include <chrono>
#include <cmath>
#include <optional>

#include "legs.h"

namespace ladder {
namespace {

using Clock = std::chrono::steady_clock;
using Placements = Eigen::Matrix<double, kFrames, 12, Eigen::RowMajor>;

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

int frames_of(const Task& task, double duration) {
  return std::max(2, static_cast<int>(std::lround(duration * task.rate)) + 1);
}

void resize(Result& r, int frames) {
  r.effort = study::Effort(static_cast<std::size_t>(frames), kJoints);
  r.q.setZero(frames, kJoints);
  r.hand_forces.setZero(frames, 6);
}

/// Frames of both trees in the world.
Placements placements(const Task& task, Hand held, int bar, const Joints& q) {
  Placements out;
  const Tree& t = tree(held);
  t.fk(t.own(q), out.data());
  out.rightCols<3>().rowwise() += grip(task, held, bar).transpose();
  return out;
}

/// Rows of one frame, in the common order; scratch vectors are kept from call to call.
class Recorder {
 public:
  explicit Recorder(Result& r) : r_(r) {}

  void state(int k, double t, Hand held, const State& s) {
    const Tree& of = tree(held);
    q_ = of.own(s.q), v_ = of.own(s.v), a_ = of.own(s.a);
    of.rnea(q_, v_, a_, tau_);
    of.segment_rates(q_, v_, segment_);
    r_.effort.times[static_cast<std::size_t>(k)] = t;
    r_.effort.torques.row(k) = of.canonical(tau_).transpose();
    r_.effort.segment_rates.row(k) = of.canonical(segment_).transpose();
    r_.effort.rates.row(k) = s.v.transpose();
    r_.effort.accelerations.row(k) = s.a.transpose();
    r_.effort.energies[k] = of.kinetic_energy(q_, v_);
    r_.q.row(k) = s.q.transpose();
    double dh[6];
    of.momentum_rate(q_, v_, a_, dh);
    r_.hand_forces.row(k).segment<3>(held == kRight ? 0 : 3) = Eigen::Map<Eigen::RowVector3d>(dh);
    const Tree& right = tree(kRight);
    r_.joint_speed = std::max(r_.joint_speed, s.v.cwiseAbs().maxCoeff());
    r_.limit_excess = std::max({r_.limit_excess, (right.q_lower - Vector(s.q)).maxCoeff(),
                                (Vector(s.q) - right.q_upper).maxCoeff()});
  }

 private:
  Result& r_;
  Vector q_, v_, a_, tau_, segment_;
};

/// Velocity of the torso along the ladder.
double torso_speed(Hand held, const State& s) {
  const Tree& t = tree(held);
  Eigen::Matrix<double, 6 * kFrames, kJoints> J;
  t.jacobian(t.own(s.q), J.data());
  return J.row(6 * kTorso + 2).dot(t.own(s.v));
}

void check_ends(const Plan& plan, Result& r) {
  for (std::size_t k = 0; k < plan.periods.size(); ++k) {
    const Period& p = plan.periods[k];
    for (const bool last : {false, true}) {
      const State s = p.at(last ? p.end : p.begin);
      const Placements at = placements(plan.task, p.held, p.bar, s.q);
      const Hand moves = other(p.held);
      const Vector3 hand = at.row(moves == kRight ? kRightHand : kLeftHand).tail<3>();
      r.hand_error =
          std::max(r.hand_error, (hand - grip(plan.task, moves, last ? p.to : p.from)).norm());
      const double global = plan.torso_stops.empty()
                                ? plan.torso(last ? p.end : p.begin).velocity
                                : plan.torso_stops[k](last ? p.end : p.begin).velocity;
      r.torso_mismatch = std::max(r.torso_mismatch, std::fabs(torso_speed(p.held, s) - global));
    }
    if (k == 0) continue;
    // The same state in both trees, where the hands change.
    const Period& before = plan.periods[k - 1];
    const State s = p.at(p.begin), e = before.at(before.end);
    const Placements here = placements(plan.task, p.held, p.bar, s.q),
                     there = placements(plan.task, before.held, before.bar, e.q);
    const Tree &a = tree(p.held), &b = tree(before.held);
    r.reroot_error = std::max({r.reroot_error, (here - there).cwiseAbs().maxCoeff(),
                               std::fabs(a.kinetic_energy(a.own(s.q), a.own(s.v)) -
                                         b.kinetic_energy(b.own(e.q), b.own(e.v)))});
  }
}

void check_inside(const Plan& plan, Result& r) {
  const Task& task = plan.task;
  r.clearance = HUGE_VAL;
  for (std::size_t k = 0; k < r.effort.times.size(); ++k) {
    const double t = r.effort.times[k];
    const Period& p = plan.period(t);
    const State s = p.at(t);
    r.torso_mismatch_inside = std::max(
        r.torso_mismatch_inside, std::fabs(torso_speed(p.held, s) - plan.torso_height(t).velocity));
    const Hand moves = other(p.held);
    const Placements at = placements(task, p.held, p.bar, s.q);
    const Vector3 hand = at.row(moves == kRight ? kRightHand : kLeftHand).tail<3>();
    for (int bar = p.from + 1; bar < p.to; ++bar)
      r.clearance = std::min(r.clearance, (hand - grip(task, moves, bar)).norm());
  }
  if (!std::isfinite(r.clearance)) r.clearance = 0;
}

/// Kinetic energy against the work of the joints, by five Gauss points on each part of a period.
void balance(const Plan& plan, Result& r) {
  double work = 0;
  Vector tau;
  const auto rate_of_work = [&](const Period& p, double t) {
    const Tree& of = tree(p.held);
    const State s = p.at(t);
    const Vector q = of.own(s.q), v = of.own(s.v), a = of.own(s.a);
    of.rnea(q, v, a, tau);
    return tau.dot(v);
  };
  const arboc::Quadrature rule = arboc::gauss_legendre(5);
  for (const Period& p : plan.periods) {
    constexpr int kParts = 80;
    const double h = p.duration() / kParts;
    const Tree& of = tree(p.held);
    for (int k = 0; k < kParts; ++k) {
      const double t = p.begin + k * h;
      for (int i = 0; i < 5; ++i)
        work += h / 2 * rule.weights[i] * rate_of_work(p, t + h / 2 * (1 + rule.instants[i]));
      const State s = p.at(t + h);
      const double T = of.kinetic_energy(of.own(s.q), of.own(s.v));
      r.power_balance = std::max(r.power_balance, std::fabs(T - work));
    }
  }
}

/// `held`, `bar` of each frame.
template <class HeldAt>
void draw(const Task& task, const std::string& name, HeldAt&& held_at, Result& r) {
  study::Animation& a = r.animation;
  a.name = name;
  a.bodies = {"right_hand", "right_elbow", "right_shoulder", "torso",  "left_shoulder",
              "left_elbow", "left_hand",   "thighs",         "shanks", "torso_centre",
              "feet"};
  a.times = r.effort.times;
  a.placements.resize(r.q.rows(), 12 * kFrames);
  for (Eigen::Index k = 0; k < r.q.rows(); ++k) {
    const auto [held, bar] = held_at(a.times[static_cast<std::size_t>(k)]);
    const Placements at = placements(task, held, bar, r.q.row(k).transpose());
    a.placements.row(k) = Eigen::Map<const Eigen::RowVectorXd>(at.data(), at.size());
  }
  a.add_limb(
      {"right_hand", "right_elbow", "right_shoulder", "left_shoulder", "left_elbow", "left_hand"},
      0.035);
  a.add_limb({"thighs", "shanks", "feet"}, 0.06);
  const Vector3 middle(0, lengths().shoulders / 2, 0);
  a.sticks.push_back({{kTorso, middle}, {kThighs, Vector3::Zero()}, 0.1});
  a.sticks.push_back({{kTorso, middle}, {kTorso, middle + Vector3(0.03, 0, 0.28)}, 0.07});
  const double bottom = -task.spacing, top = task.spacing * (task.bars + 1), side = 0.12;
  for (const double y : {-side, lengths().shoulders + side})
    a.fixtures.push_back({{0, y, bottom}, {0, y, top}, 0.02});
  for (int bar = 0; bar <= task.bars; ++bar)
    a.fixtures.push_back({{0, -side, task.spacing * bar},
                          {0, lengths().shoulders + side, task.spacing * bar},
                          0.015});
  a.forces = {{"bar on the right hand", {kRightHand, Vector3::Zero()}, r.hand_forces.leftCols<3>()},
              {"bar on the left hand", {kLeftHand, Vector3::Zero()}, r.hand_forces.rightCols<3>()}};
  a.metre_per_newton = 4e-3;
}

void finish(Result& r) {
  r.energy = study::expenditure(r.effort);
  r.peaks = study::peaks(joints(), r.effort);
}

}  // namespace

Result traverse(const Task& task) {
  const auto begin = Clock::now();
  const Plan plan = ladder::plan(task);
  Result r;
  const int frames = frames_of(task, plan.duration());
  resize(r, frames);
  Recorder recorder(r);
  std::optional<FloatingLegs> legs;
  if (task.floating) legs.emplace(plan);
  for (int k = 0; k < frames; ++k) {
    const double t = plan.duration() * k / (frames - 1);
    const Period& p = plan.period(t);
    recorder.state(k, t, p.held, legs ? legs->at(t) : p.at(t));
  }
  finish(r);
  check_ends(plan, r);
  r.seconds = since(begin);
  for (const Period& p : plan.periods)
    r.schedule.push_back({p.begin, p.end, p.held, p.bar, p.from, p.to});
  r.stretch = plan.stretch;
  check_inside(plan, r);
  if (legs)
    r.power_balance = legs->balance();
  else
    balance(plan, r);
  draw(
      task, task.name,
      [&](double t) {
        const Period& p = plan.period(t);
        return std::pair(p.held, p.bar);
      },
      r);
  return r;
}

Result both_hands(const Task& task) {
  const auto begin = Clock::now();
  const BothHands& both = *task.both;
  const Vector3 right = grip(task, kRight, both.bars[kRight]),
                hand = grip(task, kLeft, both.bars[kLeft]) - right;
  const auto along = [&](double from, double to) {
    return arboc::MotionFunction::limited({from, to, 0, task.duration}, task.torso_speed);
  };
  // Shoulders from the right hand: the mean of the hands is half of `hand` above it.
  const auto x = along(task.torso.x, both.to.x),
             z = along(task.torso.z + hand[2] / 2, both.to.z + hand[2] / 2),
             pitch = arboc::MotionFunction::quintic(
                 {task.torso.pitch, both.to.pitch, 0, task.duration});
  Result r;
  const int frames = frames_of(task, task.duration);
  resize(r, frames);
  Recorder recorder(r);
  Vector3 legs = Vector3::Zero();
  for (const auto& [name, angle] : task.legs) {
    if (joint(name) < kArms)
      throw std::invalid_argument("legs: '" + name + "' is a joint of an arm");
    legs[joint(name) - kArms] = angle;
  }
  for (int k = 0; k < frames; ++k) {
    const double t = task.duration * k / (frames - 1);
    const auto X = x(t), Z = z(t), P = pitch(t);
    const TorsoState torso{{X.position, Z.position, P.position},
                           X.velocity,
                           Z.velocity,
                           P.velocity,
                           X.acceleration,
                           Z.acceleration,
                           P.acceleration};
    const Closed c = closed(torso, hand, task.elbows, legs);
    recorder.state(k, t, kRight, c.state);
    r.effort.torques.row(k) = c.tau.transpose();
    r.hand_forces.row(k).tail<3>() = c.lambda.head<3>().transpose();
    r.hand_forces.row(k).head<3>() -= c.lambda.head<3>().transpose();
    r.loop_error = std::max(r.loop_error, c.hand_error);
    r.loop_speed = std::max(r.loop_speed, c.hand_speed);
  }
  finish(r);
  r.hand_error = r.loop_error;
  r.seconds = since(begin);
  draw(
      task, task.name, [&](double) { return std::pair(kRight, both.bars[kRight]); }, r);
  return r;
}

}  // namespace ladder

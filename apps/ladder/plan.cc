#include "plan.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace ladder {
namespace {

/// The instant at which a rising motion is at `height`.
double when(const arboc::MotionFunction& motion, double height) {
  double low = motion.begin(), high = motion.end();
  if (height <= motion(low).position) return low;
  if (height >= motion(high).position) return high;
  for (int k = 0; k < 200 && low < high; ++k) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (motion(middle).position < height ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Hands and bars: the first and the last period move a hand by one bar, the others by two.
std::vector<Period> schedule(const Task& task) {
  std::vector<Period> out;
  std::array<int, 2> at = {0, 0};
  Hand moves = task.first;
  while (at[kRight] < task.bars || at[kLeft] < task.bars) {
    Period p;
    p.held = other(moves);
    p.bar = at[p.held];
    p.from = at[moves];
    p.to = std::min(p.bar + 1, task.bars);
    at[moves] = p.to;
    moves = other(moves);
    out.push_back(p);
  }
  return out;
}

/// Half way between the hands, at the beginning of a period and at its end.
double middle(const Task& task, const Period& p, bool at_end) {
  return task.spacing * (p.bar + (at_end ? p.to : p.from)) / 2;
}

Vector3 legs(const Task& task) {
  Vector3 out = Vector3::Zero();
  for (const auto& [name, angle] : task.legs) {
    const int j = joint(name);
    if (j < kArms) throw std::invalid_argument("legs: '" + name + "' is a joint of an arm");
    out[j - kArms] = angle;
  }
  return out;
}

/// Angles, rates and accelerations where the hands are on two bars.
State on_bars(const Task& task, double middle_height, int right_bar, int left_bar, double v,
              double a) {
  TorsoState torso{task.torso, 0, v, 0, 0, a, 0};
  torso.at.z += middle_height - task.spacing * right_bar;
  const Vector3 hand = grip(task, kLeft, left_bar) - grip(task, kRight, right_bar);
  return moving(inverse(torso.at, hand, task.elbows, legs(task)), torso);
}

State at_end_of(const Task& task, const Period& p, bool at_end, double v, double a) {
  const int other_bar = at_end ? p.to : p.from;
  const bool right = p.held == kRight;
  return on_bars(task, middle(task, p, at_end), right ? p.bar : other_bar,
                 right ? other_bar : p.bar, v, a);
}

/// The quintic that has the states of both ends.
void set_powers(Period& p) {
  const double T = p.duration();
  const Joints v0 = T * p.first.v, v1 = T * p.last.v, a0 = T * T * p.first.a, a1 = T * T * p.last.a;
  const Joints d = p.last.q - p.first.q;
  p.powers = {p.first.q,
              v0,
              a0 / 2,
              10 * d - 6 * v0 - 4 * v1 - (3 * a0 - a1) / 2,
              -15 * d + 8 * v0 + 7 * v1 + (3 * a0 - 2 * a1) / 2,
              6 * d - 3 * (v0 + v1) - (a0 - a1) / 2};
}

/// The moving hand half way is at least so far from the bars' plane: shoulder, elbow and wrist of
/// its arm, by Newton steps.
void set_bump(Period& p, const Task& task) {
  if (std::abs(p.to - p.from) < 2) return;  // no bar is passed
  const bool right = p.held == kLeft;       // the arm that moves
  const Tree& t = tree(p.held);
  const std::array<int, 3> of =
      right ? std::array<int, 3>{joint("r_shoulder.y"), joint("r_elbow"), joint("r_wrist.y")}
            : std::array<int, 3>{joint("l_shoulder.y"), joint("l_elbow"), joint("l_wrist.y")};
  const int frame = right ? kRightHand : kLeftHand;
  const Joints half = p.at((p.begin + p.end) / 2).q;
  double at[12 * kFrames];
  t.fk(t.own(half), at);
  const double x = -task.clearance, z = at[12 * frame + 11];
  if (at[12 * frame + 9] <= x) return;
  Eigen::Matrix<double, 6 * kFrames, kJoints> J;
  for (int step = 0; step < 50; ++step) {
    const Joints q = t.own(half + p.bump);
    t.fk(q, at);
    const Vector3 miss(x - at[12 * frame + 9], z - at[12 * frame + 11], 0);
    if (miss.norm() < 1e-9) return;
    t.jacobian(q, J.data());
    Eigen::Matrix3d A;
    for (int k = 0; k < 3; ++k) {
      const int column = t.index[static_cast<std::size_t>(of[static_cast<std::size_t>(k)])];
      A.col(k) << J(6 * frame, column), J(6 * frame + 2, column), J(6 * frame + 4, column);
    }
    const Vector3 change = A.fullPivLu().solve(miss);
    for (int k = 0; k < 3; ++k) p.bump[of[static_cast<std::size_t>(k)]] += change[k];
  }
  throw NoPosture("the moving arm finds no way around a bar with this clearance");
}

/// Largest speed of any joint over the limit.
double excess(const Plan& plan) {
  double most = 0;
  for (const Period& p : plan.periods)
    for (int k = 0; k <= 64; ++k)
      most = std::max(most, p.at(p.begin + p.duration() * k / 64).v.cwiseAbs().maxCoeff());
  return most / plan.task.joint_speed;
}

void plan_smoothly(Plan& plan, double duration) {
  const Task& task = plan.task;
  plan.torso =
      arboc::MotionFunction::limited({0, task.bars * task.spacing, 0, duration}, task.torso_speed);
  for (Period& p : plan.periods) {
    p.begin = when(plan.torso, middle(task, p, false));
    p.end = when(plan.torso, middle(task, p, true));
    const arboc::MotionSample a = plan.torso(p.begin), b = plan.torso(p.end);
    p.first = at_end_of(task, p, false, a.velocity, a.acceleration);
    p.last = at_end_of(task, p, true, b.velocity, b.acceleration);
    p.bump.setZero();
    set_powers(p);
    set_bump(p, task);
  }
}

/// Each period from rest to rest in a time that goes with its way; joints in three phases.
void plan_with_stops(Plan& plan, double duration) {
  const Task& task = plan.task;
  const double way = task.bars * task.spacing;
  plan.torso_stops.clear();
  double t = 0;
  for (Period& p : plan.periods) {
    const double from = middle(task, p, false), to = middle(task, p, true);
    p.begin = t;
    p.end = t += duration * (to - from) / way;
    plan.torso_stops.push_back(
        arboc::MotionFunction::limited({from, to, p.begin, p.duration()}, task.torso_speed));
    p.first = at_end_of(task, p, false, 0, 0);
    p.last = at_end_of(task, p, true, 0, 0);
    p.stops.clear();
    for (int j = 0; j < kJoints; ++j)
      p.stops.push_back(arboc::MotionFunction::limited(
          {p.first.q[j], p.last.q[j], p.begin, p.duration()}, task.joint_speed));
    p.bump.setZero();
    set_bump(p, task);
  }
}

}  // namespace

State Period::at(double t) const {
  const double T = duration(), s = std::clamp((t - begin) / T, 0.0, 1.0), r = 1 - s;
  State out;
  if (stops.empty()) {
    const std::array<Joints, 6>& c = powers;
    out.q = c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
    out.v = (c[1] + s * (2 * c[2] + s * (3 * c[3] + s * (4 * c[4] + s * 5 * c[5])))) / T;
    out.a = (2 * c[2] + s * (6 * c[3] + s * (12 * c[4] + s * 20 * c[5]))) / (T * T);
  } else {
    for (int j = 0; j < kJoints; ++j) {
      const arboc::MotionSample x = stops[static_cast<std::size_t>(j)](t);
      out.q[j] = x.position, out.v[j] = x.velocity, out.a[j] = x.acceleration;
    }
  }
  const double sr = s * r;
  out.q += 64 * sr * sr * sr * bump;
  out.v += 64 * 3 * sr * sr * (r - s) / T * bump;
  out.a += 64 * 6 * sr * ((r - s) * (r - s) - sr) / (T * T) * bump;
  return out;
}

Vector3 grip(const Task& task, Hand hand, int bar) {
  return {0, hand == kLeft ? lengths().shoulders : 0, task.spacing * bar};
}

const Period& Plan::period(double t) const {
  const auto after = std::upper_bound(periods.begin() + 1, periods.end(), t,
                                      [](double x, const Period& p) { return x < p.begin; });
  return *(after - 1);
}

arboc::MotionSample Plan::torso_height(double t) const {
  if (torso_stops.empty()) return torso(t);
  return torso_stops[static_cast<std::size_t>(&period(t) - periods.data())](t);
}

Plan plan(const Task& task) {
  Plan out{task, arboc::MotionFunction::quintic({0, 1, 0, 1}), {}, schedule(task), 1};
  double duration = task.duration;
  for (int trial = 0; trial < 20; ++trial) {
    (task.stops ? plan_with_stops : plan_smoothly)(out, duration);
    const double over = excess(out);
    if (over <= 1) break;
    duration *= 1.001 * over;
  }
  out.stretch = duration / task.duration;
  return out;
}

}  // namespace ladder

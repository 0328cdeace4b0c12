// Motions from rest to rest in a given time, with continuous accelerations; [Astronaut] section 3.
//
// The quintic (1): x(t) = X s^3 (10 - 15 s + 6 s^2), s = t/T, is fastest half way, 15 X / (8 T).
// Where that exceeds a limit V, three phases: half a quintic up to V in t2, V for t1, half a
// quintic down.  A ramp covers 8/15 V t2, so from X = V t1 + 16/15 V t2 and T = t1 + 2 t2
//     t2 = 15/14 (T - X/V),   t1 = 15/7 X/V - 8/7 T,
// which is the quintic where 15 X / (8 T) = V, and does not exist where X/T >= V.
//
//   const auto reach = arboc::MotionFunction::limited({0.1, 1.2, 0, 2}, 0.9);  // from, to, s, s
//   reach(0.7).velocity
//   const auto hand = arboc::MotionPath::along_line({from, to, 0, 2}, 0.5);    // of vectors
#ifndef ARBOC_MOTION_POINT_TO_POINT_HPP
#define ARBOC_MOTION_POINT_TO_POINT_HPP

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace arboc {
inline namespace v1 {

/// The speed limit is too low for the distance and the time.
class NoSuchMotion : public std::domain_error {
 public:
  NoSuchMotion(double distance, double duration, double speed_limit)
      : std::domain_error(text(distance, duration, speed_limit)),
        minimum_time(speed_limit > 0 ? std::fabs(distance) / speed_limit : HUGE_VAL) {}

  /// s; the motion exists for every longer one.
  double minimum_time;

 private:
  static std::string number(double x) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.6g", x);
    return digits;
  }
  static std::string text(double X, double T, double V) {
    if (!(V > 0)) return "no such motion: the speed limit " + number(V) + " is not positive";
    return "no such motion: " + number(std::fabs(X)) + " in " + number(T) + " s at no more than " +
           number(V) + " per s; minimum time is " + number(std::fabs(X) / V) +
           " s, which it must exceed";
  }
};

/// What is asked for: rad or m, and s.
template <class Value>
struct Move {
  Value from, to;
  double begin = 0, duration = 1;
};

/// Of one coordinate: rad or m, per s, s^2, s^3.
template <class Value>
struct MotionSampleOf {
  Value position, velocity, acceleration, jerk;
};
using MotionSample = MotionSampleOf<double>;

/// One coordinate's motion; before and after it stands still.
class MotionFunction {
 public:
  /// (1).
  static MotionFunction quintic(const Move<double>& move) {
    return MotionFunction(move, move.duration / 2);
  }
  /// No faster than speed_limit: the quintic where that will do, otherwise three phases.  Throws
  /// NoSuchMotion.
  static MotionFunction limited(const Move<double>& move, double speed_limit) {
    check(move);
    const double X = std::fabs(move.to - move.from), T = move.duration;
    if (X == 0 || 15 * X <= 8 * T * speed_limit) return quintic(move);
    if (!(X < T * speed_limit)) throw NoSuchMotion(X, T, speed_limit);
    return MotionFunction(move, 15.0 / 14 * (T - X / speed_limit));
  }

  double begin() const { return begin_; }
  double end() const { return begin_ + duration_; }
  double duration() const { return duration_; }
  double ramp_time() const { return ramp_; }                    ///< t2
  double cruise_time() const { return duration_ - 2 * ramp_; }  ///< t1
  double peak_velocity() const { return peak_; }                ///< signed

  /// At the joins of the phases, and at both ends, jerk is that of the right-hand side.
  MotionSample operator()(double t) const {
    const double elapsed = t - begin_, left = duration_ - elapsed;
    if (elapsed < 0) return {from_, 0, 0, 0};
    if (left <= 0) return {to_, 0, 0, 0};
    if (elapsed < ramp_) {
      MotionSample up = ramp(elapsed);
      up.position += from_;
      return up;
    }
    if (left <= ramp_) {  // the first ramp run backwards
      const MotionSample down = ramp(left);
      return {to_ - down.position, down.velocity, -down.acceleration, down.jerk};
    }
    return {from_ + peak_ * (8.0 / 15 * ramp_ + (elapsed - ramp_)), peak_, 0, 0};
  }

 private:
  MotionFunction(const Move<double>& move, double ramp)
      : from_(move.from),
        to_(move.to),
        begin_(move.begin),
        duration_(move.duration),
        ramp_(ramp),
        peak_((move.to - move.from) / (move.duration - 14.0 / 15 * ramp)) {
    check(move);
  }
  static void check(const Move<double>& move) {
    if (!(move.duration > 0) || !std::isfinite(move.duration))
      throw std::invalid_argument("motion: the duration is not positive");
    if (!std::isfinite(move.from) || !std::isfinite(move.to) || !std::isfinite(move.begin))
      throw std::invalid_argument("motion: an end is not finite");
  }
  /// velocity = peak r^2 (2 - r)^2, r = elapsed / ramp.
  MotionSample ramp(double elapsed) const {
    const double r = elapsed / ramp_;
    return {peak_ * ramp_ * r * r * r * (4.0 / 3 - r + r * r / 5),
            peak_ * r * r * (2 - r) * (2 - r), 4 * peak_ / ramp_ * r * (2 - r) * (1 - r),
            4 * peak_ / (ramp_ * ramp_) * (2 - 6 * r + 3 * r * r)};
  }

  double from_, to_, begin_, duration_, ramp_, peak_;
};

/// A vector's motion.
class MotionPath {
 public:
  using Vector = Eigen::VectorXd;
  using Sample = MotionSampleOf<Vector>;

  /// (1) in each coordinate, which is a straight line.
  static MotionPath quintic(const Move<Vector>& move) {
    return by_coordinate(move, Vector::Constant(move.from.size(), HUGE_VAL));
  }
  /// A straight line; the limit is on the length of the velocity.
  static MotionPath along_line(const Move<Vector>& move, double speed_limit) {
    const double length = difference(move).norm();
    const double limit = length > 0 ? speed_limit / length : HUGE_VAL;
    try {
      MotionPath path(move);
      path.functions_.push_back(MotionFunction::limited({0, 1, move.begin, move.duration}, limit));
      path.line_ = true;
      return path;
    } catch (const NoSuchMotion&) {
      throw NoSuchMotion(length, move.duration, speed_limit);
    }
  }
  /// Each coordinate under its own limit, all in the same time.
  static MotionPath by_coordinate(const Move<Vector>& move, const Vector& speed_limits) {
    const Vector X = difference(move);
    if (speed_limits.size() != X.size())
      throw std::invalid_argument("motion: not one speed limit for each coordinate");
    check_slowest(X, move.duration, speed_limits);
    MotionPath path(move);
    for (Eigen::Index i = 0; i < X.size(); ++i)
      path.functions_.push_back(MotionFunction::limited(
          {move.from[i], move.to[i], move.begin, move.duration}, speed_limits[i]));
    return path;
  }

  /// One function a coordinate, or one for all, which goes from 0 to 1.
  const std::vector<MotionFunction>& functions() const { return functions_; }

  Sample operator()(double t) const {
    if (line_) {
      const MotionSample s = functions_[0](t);
      const Vector X = to_ - from_;
      return {s.position < 1 ? Vector(from_ + s.position * X) : to_, s.velocity * X,
              s.acceleration * X, s.jerk * X};
    }
    const Eigen::Index n = from_.size();
    Sample x{Vector(n), Vector(n), Vector(n), Vector(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
      const MotionSample s = functions_[static_cast<std::size_t>(i)](t);
      x.position[i] = s.position;
      x.velocity[i] = s.velocity;
      x.acceleration[i] = s.acceleration;
      x.jerk[i] = s.jerk;
    }
    return x;
  }

 private:
  explicit MotionPath(const Move<Vector>& move) : from_(move.from), to_(move.to) {}
  static Vector difference(const Move<Vector>& move) {
    if (move.from.size() != move.to.size())
      throw std::invalid_argument("motion: the ends differ in size");
    return move.to - move.from;
  }
  /// The complaint is of the coordinate that needs the longest time.
  static void check_slowest(const Vector& X, double T, const Vector& V) {
    Eigen::Index worst = 0;
    double longest = 0;
    for (Eigen::Index i = 0; i < X.size(); ++i) {
      const double needed = X[i] == 0 ? 0 : V[i] > 0 ? std::fabs(X[i]) / V[i] : HUGE_VAL;
      if (needed <= longest) continue;
      longest = needed;
      worst = i;
    }
    if (longest > 0 && T > 0 && !(longest < T)) throw NoSuchMotion(X[worst], T, V[worst]);
  }

  Vector from_, to_;
  std::vector<MotionFunction> functions_;
  bool line_ = false;
};

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_MOTION_POINT_TO_POINT_HPP

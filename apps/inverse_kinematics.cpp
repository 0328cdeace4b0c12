// Inverse kinematics of the arm's flange by Gauss-Newton: which q brings the flange to a placement?
//
// The error is the motion that is left, in the flange's axes: e = (R^T (p_d - p), log(R^T R_d)).
// It changes with the flange's velocity, -J dq to first order, so each step solves
// (J^T J + mu) dq = J^T e, with little damping mu (Levenberg-Marquardt) where a step does not help.
// Starts anew at random where it gets stuck; the targets are placements of random configurations.
//
//   inverse_kinematics [TARGETS]
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <arm/arm.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

struct Placement {
  Eigen::Matrix3d R;
  Eigen::Vector3d p;
};

Placement flange(const arm::Config& q) {
  const auto row = arm::fk(q);  // R by rows, p
  Placement X;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X.R(i, j) = row(0, 3 * i + j);
    X.p[i] = row(0, 9 + i);
  }
  return X;
}

/// What moves the flange from `is` to `wanted`: linear then angular, in its own axes.
Vector6 error(const Placement& wanted, const Placement& is) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(is.R.transpose() * wanted.R));
  Vector6 e;
  e << is.R.transpose() * (wanted.p - is.p), turn.angle() * turn.axis();
  return e;
}

struct Solution {
  arm::Config q;
  double error = 1;
  int steps = 0;
};

/// From one start, until the error no longer falls.
Solution descend(const Placement& wanted, arm::Config q) {
  Solution best{q, error(wanted, flange(q)).norm(), 0};
  double mu = 1e-3;
  for (int step = 1; step <= 60 && best.error > 1e-12 && mu < 1e6; ++step) {
    const arm::Matrix J = arm::frame_jacobian(best.q);
    const Vector6 e = error(wanted, flange(best.q));
    const arm::Matrix H = J.transpose() * J + mu * arm::Matrix::Identity();
    const arm::Config next = best.q + H.ldlt().solve(J.transpose() * e);
    const double left = error(wanted, flange(next)).norm();
    best.steps = step;
    if (left < best.error) {
      best.q = next;
      best.error = left;
      mu *= 0.1;
    } else {
      mu *= 10;
    }
  }
  return best;
}

}  // namespace

int main(int argc, char** argv) {
  const int targets = argc > 1 ? std::atoi(argv[1]) : 500;
  std::mt19937_64 random(7);
  const auto configuration = [&] {
    arm::Config q;
    for (int i = 0; i < arm::nq; ++i)
      q[i] = 2e-19 * static_cast<double>(random()) - 1.8446744;  // +-1.84 rad on every machine
    return q;
  };
  int solved = 0, starts = 0, steps = 0;
  double worst = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < targets; ++k) {
    const Placement wanted = flange(configuration());
    Solution s;
    for (int start = 0; start < 50 && s.error > 1e-9; ++start, ++starts) {
      s = descend(wanted, configuration());
      steps += s.steps;
    }
    solved += s.error <= 1e-9;
    worst = std::max(worst, s.error);
  }
  const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
  std::printf("%d of %d targets, %.2f starts and %.1f steps each, %.1f us each, worst error %.1e\n",
              solved, targets, 1.0 * starts / targets, 1.0 * steps / targets,
              time.count() / targets, worst);
  return targets > 0 && solved == targets ? 0 : 1;
}

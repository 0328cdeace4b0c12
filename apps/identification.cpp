// Identification of the arm's inertial parameters from torques: tau = Y(q, v, a) pi is linear in
// the ten parameters a link, so they are a least-squares fit.
//
// Not all of them move the arm: the regressor of all samples has a null space, and its rank is the
// number of base parameters.  The fit of least norm has the same torques as the true parameters, on
// motions that were not measured too; that is what is checked.
//
//   identification [NOISE]   standard deviation of the torques, N m
#include <Eigen/QR>
#include <Eigen/SVD>
#include <arm/arm.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace {

constexpr int kParameters = 60;  // ten a link
constexpr int kSamples = 400;

struct Motion {
  arm::Tangent q, v, a;
};

/// Fourier series of a few harmonics with random coefficients: excites all joints at once.
class Excitation {
 public:
  explicit Excitation(unsigned seed) {
    std::mt19937_64 random(seed);
    for (auto& joint : coefficient_)
      for (double& c : joint) c = 1.1e-19 * static_cast<double>(random()) - 1;  // within +-1
  }

  Motion at(double t) const {
    Motion m{arm::Tangent::Zero(), arm::Tangent::Zero(), arm::Tangent::Zero()};
    for (int i = 0; i < arm::nv; ++i) {
      for (int k = 1; k <= kHarmonics; ++k) {
        const double w = 0.7 * k, s = std::sin(w * t), c = std::cos(w * t);
        const double a = coefficient_[i][2 * k - 2] / k, b = coefficient_[i][2 * k - 1] / k;
        m.q[i] += a * s + b * c;
        m.v[i] += w * (a * c - b * s);
        m.a[i] -= w * w * (a * s + b * c);
      }
    }
    return m;
  }

 private:
  static constexpr int kHarmonics = 5;
  double coefficient_[arm::nv][2 * kHarmonics];
};

struct Measurements {
  Eigen::MatrixXd Y{arm::nv * kSamples, kParameters};
  Eigen::VectorXd tau{arm::nv * kSamples};
};

Measurements measure(const Excitation& motion, double noise, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> error(0, 1);
  Measurements out;
  for (int s = 0; s < kSamples; ++s) {
    const Motion m = motion.at(0.05 * s);
    out.Y.middleRows<arm::nv>(arm::nv * s) = arm::regressor(m.q, m.v, m.a);
    out.tau.segment<arm::nv>(arm::nv * s) = arm::rnea(m.q, m.v, m.a);
  }
  for (double& x : out.tau) x += noise * error(random);
  return out;
}

double rms(const Eigen::VectorXd& x) { return x.norm() / std::sqrt(static_cast<double>(x.size())); }

}  // namespace

int main(int argc, char** argv) {
  const double noise = argc > 1 ? std::atof(argv[1]) : 0.5;
  const Measurements train = measure(Excitation(1), noise, 2);
  const Measurements test = measure(Excitation(3), 0, 4);

  Eigen::JacobiSVD<Eigen::MatrixXd> svd(train.Y, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(1e-10);
  const auto rank = svd.rank();
  const Eigen::VectorXd pi = svd.solve(train.tau);
  const auto& sigma = svd.singularValues();
  const double residual = rms(train.tau - train.Y * pi), predicted = rms(test.tau - test.Y * pi);
  std::printf(
      "%d torques of %.1f N m rms, noise %.3g N m; %d parameters, %ld base parameters, "
      "condition %.0f\n",
      arm::nv * kSamples, rms(train.tau), noise, kParameters, static_cast<long>(rank),
      sigma[0] / sigma[rank - 1]);
  std::printf("residual %.3g N m; on another motion off by %.3g N m of %.1f N m\n", residual,
              predicted, rms(test.tau));

  // Without noise the fit is exact but for rounding times the condition.
  const Measurements exact = measure(Excitation(1), 0, 2);
  const double rounding = rms(test.tau - test.Y * svd.solve(exact.tau));
  std::printf("without noise off by %.1e N m\n", rounding);
  // The residual of n torques is the noise less what the fit takes up; what it predicts is off by
  // that part, sqrt(rank / n) of the noise where the two motions are alike.
  const double part = std::sqrt(static_cast<double>(rank) / static_cast<double>(train.tau.size()));
  return rounding < 1e-8 && std::fabs(residual - noise) <= 0.1 * noise &&
                 predicted <= 3 * part * noise + 1e-8
             ? 0
             : 1;
}

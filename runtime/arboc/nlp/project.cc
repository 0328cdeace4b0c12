#include "project.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLeastDamping = 1e-8, kMostDamping = 1e6;

class Projector {
 public:
  Projector(Nlp& nlp, const ProjectOptions& options)
      : nlp_(nlp), options_(options), v_(nlp.variables()), r_(nlp.rows()) {}

  Projection run(std::vector<double> x) {
    Projection out;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::clamp(x[i], v_.lower[i], v_.upper[i]);
    double damping = 1e-4;
    VectorXd miss = misses(x);
    for (; out.iterations < options_.max_iterations && damping < kMostDamping; ++out.iterations) {
      if (largest(miss) <= options_.tolerance) break;
      linearise(x);
      // The same linearisation serves until a step is good.
      for (; damping < kMostDamping; damping *= 8) {
        const std::vector<double> next = step(x, miss, damping);
        const VectorXd there = misses(next);
        if (there.squaredNorm() > (1 - 1e-4) * miss.squaredNorm()) continue;
        x = next;
        miss = there;
        damping = std::max(damping / 16, kLeastDamping);
        break;
      }
    }
    out.violation = largest(miss);
    out.met = out.violation <= options_.tolerance;
    out.x = std::move(x);
    return out;
  }

 private:
  static double largest(const VectorXd& miss) {
    return miss.size() == 0 ? 0 : miss.cwiseAbs().maxCoeff();
  }

  /// How far rows are above (+) or below (-) their bounds, scaled.
  VectorXd misses(const std::vector<double>& x) {
    nlp_.move_to(x.data());
    const std::vector<double>& c = nlp_.constraints();
    VectorXd miss(static_cast<Eigen::Index>(c.size()));
    for (std::size_t k = 0; k < c.size(); ++k)
      miss[static_cast<Eigen::Index>(k)] =
          (c[k] - std::clamp(c[k], r_.lower[k], r_.upper[k])) / r_.scale[k];
    return miss;
  }

  void linearise(const std::vector<double>& x) {
    nlp_.move_to(x.data());
    const std::vector<double>& J = nlp_.jacobian();
    const Pattern& at = nlp_.jacobian_pattern();
    J_ = MatrixXd::Zero(static_cast<Eigen::Index>(r_.size()), static_cast<Eigen::Index>(v_.size()));
    for (std::size_t k = 0; k < J.size(); ++k)
      J_(at.row[k], at.col[k]) = J[k] * v_.scale[at.col[k]] / r_.scale[at.row[k]];
  }

  /// Variables that the step would push out of their bounds stay at them, one round after another.
  std::vector<double> step(const std::vector<double>& x, const VectorXd& miss, double damping) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index k = 0; k < miss.size(); ++k)
      if (miss[k] != 0) rows.push_back(k);
    const MatrixXd J = J_(rows, Eigen::all);
    const VectorXd b = miss(rows);
    VectorXd free = VectorXd::Ones(J.cols());
    for (Eigen::Index i = 0; i < J.cols(); ++i)
      if (v_.lower[i] == v_.upper[i]) free[i] = 0;
    std::vector<double> next = x;
    for (int round = 0; round < 4; ++round) {
      const MatrixXd JF = J * free.asDiagonal();
      MatrixXd A = JF * JF.transpose();
      A.diagonal().array() += damping;
      VectorXd d = -JF.transpose() * A.ldlt().solve(b);
      const double size = d.cwiseAbs().maxCoeff();
      if (size > options_.longest) d *= options_.longest / size;
      bool held = false;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const double to = x[i] + d[static_cast<Eigen::Index>(i)] * v_.scale[i];
        next[i] = std::clamp(to, v_.lower[i], v_.upper[i]);
        if (next[i] == to || next[i] != x[i]) continue;
        free[static_cast<Eigen::Index>(i)] = 0;
        held = true;
      }
      if (!held) break;
    }
    return next;
  }

  Nlp& nlp_;
  const ProjectOptions& options_;
  const Scales &v_, &r_;
  MatrixXd J_;
};

}  // namespace

Projection project(Nlp& nlp, std::vector<double> x, const ProjectOptions& options) {
  return Projector(nlp, options).run(std::move(x));
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

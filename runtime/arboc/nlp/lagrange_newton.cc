#include "lagrange_newton.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/QR>
#include <Eigen/SparseLU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

void check(const Nlp& nlp) {
  const Scales &variables = nlp.variables(), &rows = nlp.rows();
  for (std::size_t k = 0; k < variables.size(); ++k)
    if (std::isfinite(variables.lower[k]) || std::isfinite(variables.upper[k]))
      throw std::invalid_argument("the Lagrange-Newton iteration knows no bounds of variables");
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows.lower[k] != rows.upper[k])
      throw std::invalid_argument("the Lagrange-Newton iteration knows no inequalities");
}

/// The system of one step at a point: matrix and right-hand side.
class System {
 public:
  explicit System(Nlp& nlp)
      : nlp_(nlp),
        n_(static_cast<Eigen::Index>(nlp.variables().size())),
        m_(static_cast<Eigen::Index>(nlp.rows().size())),
        residual(n_ + m_) {}

  void move_to(const Vector& x, const Vector& l) {
    nlp_.move_to(x.data());
    objective = nlp_.objective();
    Eigen::Map<const Vector> gradient(nlp_.gradient().data(), n_), c(nlp_.constraints().data(), m_);
    residual.head(n_) = gradient;
    residual.tail(m_) = c - Eigen::Map<const Vector>(nlp_.rows().lower.data(), m_);
    const Pattern& jacobian = nlp_.jacobian_pattern();
    const std::vector<double>& entries = nlp_.jacobian();
    triplets_.clear();
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const int row = jacobian.row[k], col = jacobian.col[k];
      residual[col] += l[row] * entries[k];
      add(static_cast<int>(n_) + row, col, entries[k]);
    }
    const Pattern& hessian = nlp_.hessian_pattern();
    const std::vector<double>& curvature = nlp_.hessian(1, l.data());
    for (std::size_t k = 0; k < curvature.size(); ++k)
      add(hessian.row[k], hessian.col[k], curvature[k]);
  }

  Sparse matrix() const {
    Sparse K(n_ + m_, n_ + m_);
    K.setFromTriplets(triplets_.begin(), triplets_.end());
    return K;
  }
  double stationarity() const { return residual.head(n_).norm(); }
  double violation() const { return residual.tail(m_).norm(); }

  /// F_xx along directions that the rows leave free: Z^T F_xx Z with orthonormal columns of Z.
  Eigen::MatrixXd free_curvature() const {
    const Eigen::MatrixXd K(matrix());
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(K.bottomLeftCorner(m_, n_).transpose());
    const Eigen::MatrixXd Q = qr.householderQ() * Eigen::MatrixXd::Identity(n_, n_);
    const Eigen::MatrixXd Z = Q.rightCols(n_ - qr.rank());
    return Z.transpose() * K.topLeftCorner(n_, n_) * Z;
  }
  /// Of f + mu |c|_1 along a step that would meet the rows if they were linear.
  double slope(const Vector& dx, const Vector& l, double mu) const {
    return residual.head(n_).dot(dx) + l.dot(residual.tail(m_)) -
           mu * residual.tail(m_).lpNorm<1>();
  }
  void shift(double by) {
    for (int k = 0; k < n_; ++k) add(k, k, by);
  }
  double merit(const Vector& x, double mu) {
    nlp_.move_to(x.data());
    const Eigen::Map<const Vector> c(nlp_.constraints().data(), m_),
        wanted(nlp_.rows().lower.data(), m_);
    return nlp_.objective() + mu * (c - wanted).lpNorm<1>();
  }

 private:
  void add(int i, int j, double x) {
    triplets_.emplace_back(i, j, x);
    if (i != j) triplets_.emplace_back(j, i, x);
  }

  Nlp& nlp_;
  Eigen::Index n_, m_;
  std::vector<Eigen::Triplet<double>> triplets_{};

 public:
  double objective = 0;
  Vector residual;  ///< F_x, c
};

bool positive(const Eigen::MatrixXd& A) {
  return A.size() == 0 || Eigen::LLT<Eigen::MatrixXd>(A).info() == Eigen::Success;
}

/// The least of some shifts that makes the curvature positive.
double needed_shift(Eigen::MatrixXd curvature) {
  if (positive(curvature)) return 0;
  const double size = std::max(curvature.diagonal().cwiseAbs().mean(), 1e-8);
  double total = 0;
  for (double shift = 1e-3 * size; shift < 1e12 * size; shift *= 4) {
    curvature.diagonal().array() += shift - total;
    total = shift;
    if (positive(curvature)) break;
  }
  return 2 * total;
}

/// The part of a step after which f + mu |c|_1 has fallen enough; slope: of it along the step.
double fraction(System& system, const Vector& x, const Vector& dx, double mu, double slope) {
  const double here = system.merit(x, mu);
  double part = 1;
  // Near a solution the change is below rounding of the sum.
  const double rounding = 1e-12 * (1 + std::fabs(here));
  while (part > 1e-8 && !(system.merit(x + part * dx, mu) <= here + 1e-4 * part * slope + rounding))
    part /= 2;
  return part;
}

bool small(double step, double size, double tolerance) {
  return step <= tolerance * size || step <= tolerance;
}

}  // namespace

LagrangeNewtonResult lagrange_newton(Nlp& nlp, std::vector<double> start,
                                     const LagrangeNewtonOptions& options) {
  check(nlp);
  const auto begin = std::chrono::steady_clock::now();
  const auto n = static_cast<Eigen::Index>(nlp.variables().size());
  const auto m = static_cast<Eigen::Index>(nlp.rows().size());
  Vector x = Eigen::Map<const Vector>(start.data(), n), l = Vector::Zero(m);
  System system(nlp);
  Eigen::SparseLU<Sparse> solver;
  LagrangeNewtonResult result;
  result.stop_reason = "as many iterations as allowed";
  for (int k = 0; k < options.max_iterations; ++k) {
    system.move_to(x, l);
    const double shift = options.safeguards ? needed_shift(system.free_curvature()) : 0;
    system.shift(shift);
    const Sparse K = system.matrix();
    if (k == 0) solver.analyzePattern(K);
    solver.factorize(K);
    if (solver.info() != Eigen::Success) {
      result.stop_reason =
          "the system is singular: constraints depend on each other, or directions "
          "without curvature";
      break;
    }
    const Vector step = -solver.solve(system.residual);
    if (!step.allFinite()) {
      result.stop_reason = "the step is not finite";
      break;
    }
    const double mu = 2 * (l + step.tail(m)).lpNorm<Eigen::Infinity>() + 1e-8;
    const double slope = system.slope(step.head(n), l, mu);
    const double part = options.safeguards ? fraction(system, x, step.head(n), mu, slope) : 1;
    if (part <= 1e-8) {
      result.stop_reason = "no part of the step is better";
      break;
    }
    x += part * step.head(n);
    l += part * step.tail(m);
    const double dx = part * step.head(n).norm(), dl = part * step.tail(m).norm();
    result.log.push_back({system.objective, system.stationarity(), system.violation(), dx, dl,
                          x.norm(), l.norm(), shift, part});
    if (!small(dx, x.norm(), options.tolerance) || !small(dl, l.norm(), options.tolerance))
      continue;
    result.converged = true;
    result.stop_reason = "|dx| << |x| and |dl| << |l|";
    break;
  }
  system.move_to(x, l);
  result.objective = system.objective;
  result.stationarity = system.stationarity();
  result.violation = system.violation();
  result.minimum = result.converged && positive(system.free_curvature());
  result.x.assign(x.data(), x.data() + n);
  result.multipliers.assign(l.data(), l.data() + m);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

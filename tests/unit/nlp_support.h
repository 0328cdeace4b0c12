// Differences of an Nlp's values, and a function with known derivatives.
#pragma once
#include <Eigen/Dense>
#include <arboc/nlp/assembly.hpp>
#include <cmath>
#include <random>

namespace arboc::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

inline VectorXd vector_of(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

/// By six points: with steps of 1e-2 to functions of size 1 an error of some 1e-13.
template <class F>
VectorXd difference(const F& f, VectorXd x, Eigen::Index i, double h) {
  const double at = x[i];
  const auto there = [&](int k) -> VectorXd {
    x[i] = at + k * h;
    return f(x);
  };
  return (45 * (there(1) - there(-1)) - 9 * (there(2) - there(-2)) + (there(3) - there(-3))) /
         (60 * h);
}

inline MatrixXd dense(const nlp::Pattern& at, const std::vector<double>& entries, Eigen::Index rows,
                      Eigen::Index cols, bool symmetric = false) {
  MatrixXd M = MatrixXd::Zero(rows, cols);
  for (std::size_t k = 0; k < at.size(); ++k) {
    M(at.row[k], at.col[k]) += entries[k];
    if (symmetric && at.row[k] != at.col[k]) M(at.col[k], at.row[k]) += entries[k];
  }
  return M;
}

/// Errors of gradient, Jacobian and Hessian, each over the largest entry (at least 1).
struct DerivativeErrors {
  double gradient = 0, jacobian = 0, hessian = 0;
};

inline DerivativeErrors derivative_errors(nlp::Nlp& nlp, const VectorXd& x, const VectorXd& lambda,
                                          double sigma, double step = 1e-3) {
  const Eigen::Index n = x.size(), m = lambda.size();
  const auto values = [&](const VectorXd& at) -> VectorXd {
    nlp.move_to(at.data());
    VectorXd all(m + 1);
    all << nlp.objective(), vector_of(nlp.constraints());
    return all;
  };
  const auto slope = [&](const VectorXd& at) -> VectorXd {
    nlp.move_to(at.data());
    return sigma * vector_of(nlp.gradient()) +
           dense(nlp.jacobian_pattern(), nlp.jacobian(), m, n).transpose() * lambda;
  };
  MatrixXd first(m + 1, n), second(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    first.col(i) = difference(values, x, i, step);
    second.col(i) = difference(slope, x, i, step);
  }
  nlp.move_to(x.data());
  const auto error = [](const MatrixXd& is, const MatrixXd& shall) {
    return (is - shall).cwiseAbs().maxCoeff() / std::max(1.0, shall.cwiseAbs().maxCoeff());
  };
  DerivativeErrors errors;
  errors.gradient = error(vector_of(nlp.gradient()).transpose(), first.row(0));
  if (m > 0)
    errors.jacobian =
        error(dense(nlp.jacobian_pattern(), nlp.jacobian(), m, n), first.bottomRows(m));
  errors.hessian =
      error(dense(nlp.hessian_pattern(), nlp.hessian(sigma, lambda.data()), n, n, true), second);
  return errors;
}

inline VectorXd random_vector(Eigen::Index n, std::mt19937_64& random) {
  VectorXd x(n);
  for (double& e : x) e = std::uniform_real_distribution<double>(-1, 1)(random);
  return x;
}

/// y0 = x0^2 x1 + sin(x2),  y1 = exp(x0 x2),  y2 = x1.
class Sample : public nlp::Function {
 public:
  Sample() {
    for (const auto& [r, c] : {std::pair{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 1}})
      jacobian_.push(r, c);
    for (const auto& [r, c] : {std::pair{0, 0}, {1, 0}, {2, 0}, {2, 2}}) hessian_.push(r, c);
  }
  int inputs() const override { return 3; }
  int outputs() const override { return 3; }
  const nlp::Pattern& jacobian_pattern() const override { return jacobian_; }
  const nlp::Pattern& hessian_pattern() const override { return hessian_; }
  void values(int n, const double* x, double* y) override {
    ++calls;
    for (int s = 0; s < n; ++s, x += 3, y += 3) {
      y[0] = x[0] * x[0] * x[1] + std::sin(x[2]);
      y[1] = std::exp(x[0] * x[2]);
      y[2] = x[1];
    }
  }
  void jacobian(int n, const double* x, double* J) override {
    for (int s = 0; s < n; ++s, x += 3, J += 6) {
      const double e = std::exp(x[0] * x[2]);
      const double entries[] = {2 * x[0] * x[1], x[0] * x[0], std::cos(x[2]),
                                x[2] * e,        x[0] * e,    1};
      std::copy(entries, entries + 6, J);
    }
  }
  void hessian(int n, const double* x, const double* w, double* H) override {
    for (int s = 0; s < n; ++s, x += 3, w += 3, H += 4) {
      const double e = w[1] * std::exp(x[0] * x[2]);
      const double entries[] = {2 * x[1] * w[0] + x[2] * x[2] * e, 2 * x[0] * w[0],
                                (1 + x[0] * x[2]) * e, x[0] * x[0] * e - w[0] * std::sin(x[2])};
      std::copy(entries, entries + 4, H);
    }
  }
  int calls = 0;

 private:
  nlp::Pattern jacobian_, hessian_;
};

}  // namespace arboc::test

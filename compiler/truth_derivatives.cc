#include "truth_derivatives.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "truth.h"

namespace arboc::truth {
namespace {

/// f'(0) of a polynomial of second degree, whatever the step.
template <class F>
auto central(const F& f) -> std::invoke_result_t<F, double> {
  return (f(1) - f(-1)) / 2;
}

/// f'(0) up to h^6.
template <class F>
auto six_points(const F& f, double h) -> std::invoke_result_t<F, double> {
  return (45 * (f(h) - f(-h)) - 9 * (f(2 * h) - f(-2 * h)) + (f(3 * h) - f(-3 * h))) / (60 * h);
}

}  // namespace

Derivatives::Derivatives(const Setup& setup, std::string function, std::string output,
                         const Arguments<double>& in)
    : setup_(setup), function_(std::move(function)), output_(std::move(output)), at_(setup.model) {
  for (const auto& [name, x] : in) in_[name] = x.cast<Complex>();
  if (setup.parameters.empty()) engine_.emplace(setup, setup.model);
}

/// The output; of a function that is a derivative itself its real part.
VectorOf<Complex> Derivatives::evaluate(const Arguments<Complex>& in) const {
  if (!function_.ends_with("_derivatives"))
    return (engine_ ? (*engine_)(function_, in) : plain(function_, setup_, in)).at(output_);
  Values inputs;
  for (const auto& [name, x] : in) {
    const Vector real = x.real();
    inputs[name] = {real.begin(), real.end()};
  }
  const Values outputs = evaluate_reference(Request{function_}, setup_, inputs);
  const std::vector<double>& y = outputs.at(output_);
  return Eigen::Map<const Vector>(y.data(), static_cast<Eigen::Index>(y.size())).cast<Complex>();
}

/// It is a parameter.
bool Derivatives::number(const std::string& input) const {
  return std::any_of(setup_.parameters.begin(), setup_.parameters.end(),
                     [&](const Parameter& p) { return p.name == input; });
}

bool Derivatives::analytic(const std::string& input) const {
  return input != "f_ext" && !number(input) && !function_.ends_with("_derivatives");
}

/// The output, and its derivatives by other inputs, are polynomials of degree two at most in this
/// input (of wrenches and gravity, one), so that a central difference of any length is exact.
bool Derivatives::quadratic(const std::string& input) const {
  if (function_.starts_with("integrate") || function_.starts_with("difference")) return false;
  return input == "a" || input == "tau" || input == "f_ext" || input == "gravity" ||
         (input == "v" && !setup_.joint_forces.friction);
}

/// Of differences along `direction`.  A long step leaves the least noise where any will do; along
/// many joints at once the angles of a chain add up, hence the sum of the direction's entries.
double Derivatives::step(const std::string& input, const Vector& direction) const {
  if (quadratic(input)) return 1;
  if (number(input)) return 1e-3 / direction.lpNorm<Eigen::Infinity>();
  return complex_step::difference_step(at_) / direction.lpNorm<1>();
}

/// Along `direction` at `from` from the inputs.
Eigen::VectorXd Derivatives::along_from(const Arguments<Complex>& in, const std::string& input,
                                        const VectorOf<Complex>& from,
                                        const Vector& direction) const {
  const VectorOf<Complex> to = from + direction * Complex(0, complex_step::kStep);
  return evaluate(moved(at_, in, input, to)).imag() / complex_step::kStep;
}

Eigen::VectorXd Derivatives::along(const Arguments<Complex>& in, const std::string& input,
                                   const Vector& direction) const {
  if (analytic(input))
    return along_from(in, input, VectorOf<Complex>::Zero(direction.size()), direction);
  const auto f = [&](double t) -> Vector {
    return value(moved<Complex>(at_, in, input, direction.cast<Complex>() * t));
  };
  return quadratic(input) ? central(f) : six_points(f, step(input, direction));
}

Eigen::MatrixXd Derivatives::jacobian(const std::string& input) const {
  const int n = size(input);
  Matrix J;
  for (int j = 0; j < n; ++j) {
    const Vector column = along(input, Vector::Unit(n, j));
    if (j == 0) J.resize(column.size(), n);
    J.col(j) = column;
  }
  return J;
}

double Derivatives::second(const std::string& x, const Vector& u, const std::string& y,
                           const Vector& w, const Weight& weight, bool symmetric) const {
  // Of different inputs in either order: inside a complex step, outside a difference that is exact.
  if (x != y && (analytic(x) != analytic(y) ? analytic(y) : quadratic(x) && !quadratic(y)))
    return second(y, w, x, u, weight, symmetric);
  const bool together = symmetric && x == y && analytic(x);
  const auto slope = [&](double t) {
    const VectorOf<Complex> outer = w.cast<Complex>() * t;
    const Arguments<Complex> there = moved(at_, in_, y, outer);
    const Vector inner = together ? along_from(in_, x, outer, u) : along(there, x, u);
    return weight.at(there).dot(inner);
  };
  return weight.constant && quadratic(y) ? central(slope) : six_points(slope, step(y, w));
}

Eigen::MatrixXd Derivatives::hessian(const std::string& x, const std::string& y,
                                     const Weight& weight, bool symmetric) const {
  const int n = size(x), m = size(y);
  const bool half = symmetric && x == y;
  Matrix H(n, m);
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < (half ? k + 1 : n); ++j)
      H(j, k) = second(x, Vector::Unit(n, j), y, Vector::Unit(m, k), weight, symmetric);
  if (half) H.triangularView<Eigen::StrictlyLower>() = H.transpose();
  return H;
}

}  // namespace arboc::truth

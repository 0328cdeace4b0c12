#include "truth.h"

#include <functional>
#include <memory>

#include "functions/derived_signature.h"
#include "truth_derivatives.h"

namespace arboc {
namespace {

using truth::Arguments;
using truth::by_rows;
using truth::Derivatives;
using truth::moved;
using truth::plain;
using truth::Weight;

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// The truth of an output, and l^T times it times r, which may be had without it.
struct Result {
  std::function<Matrix()> whole;
  std::function<double(const Vector& l, const Vector& r)> projection;
};
using Results = std::map<std::string, Result>;

Result known(const Matrix& Y) {
  return {[Y] { return Y; }, [Y](const Vector& l, const Vector& r) { return l.dot(Y * r); }};
}
Result known_by_rows(const Vector& y, const Argument& a) {
  return known(Eigen::Map<const Matrix>(y.data(), a.cols, a.rows).transpose());
}

Result jacobian(const std::shared_ptr<Derivatives>& of, const std::string& with) {
  return {[=] { return of->jacobian(with); },
          [=](const Vector& l, const Vector& r) { return l.dot(of->along(with, r)); }};
}

Result gradient(const std::shared_ptr<Derivatives>& of, const std::string& with,
                const Weight& weight) {
  return {[=]() -> Matrix { return of->jacobian(with).transpose() * weight.at(of->inputs()); },
          [=](const Vector& l, const Vector& r) {
            return r[0] * weight.at(of->inputs()).dot(of->along(with, l));
          }};
}

Result hessian(const std::shared_ptr<Derivatives>& of, const std::string& x, const std::string& y,
               const Weight& weight, bool symmetric) {
  return {
      [=] { return of->hessian(x, y, weight, symmetric); },
      [=](const Vector& l, const Vector& r) { return of->second(x, l, y, r, weight, symmetric); }};
}

Results derived(const Request& request, const Signature& s, const Setup& setup,
                const Arguments<double>& in) {
  const auto of = std::make_shared<Derivatives>(setup, request.function, request.output, in);
  Request base;
  base.function = request.function;
  const std::vector<std::string> with = derived_inputs(request, signature(base, setup));
  const auto lambda = in.find("lambda");
  Vector constant = Vector::Ones(1);
  if (lambda != in.end() && lambda->second.size() > 0) constant = lambda->second;
  const bool squares = request.squares;
  const Weight weight{[=](const Arguments<Complex>& at) -> Vector {
                        return squares ? Vector(2 * of->value(at)) : constant;
                      },
                      !squares};
  Results results;
  if (request.derivative != Derivative::kHessian) {
    for (size_t k = 0; k < with.size(); ++k)
      results[s.outputs[k].name] = request.derivative == Derivative::kJacobian
                                       ? jacobian(of, with[k])
                                       : gradient(of, with[k], weight);
    return results;
  }
  for (const Argument& output : s.outputs)
    for (const std::string& x : with)
      for (const std::string& y : with)
        if (output.name == "H_" + x + y)
          results[output.name] = hessian(of, x, y, weight, !setup.iterated);
  return results;
}

/// Catalogue functions of several derivatives: what of, and by what.
struct Part {
  const char *output, *function, *of, *with;
};
constexpr Part kParts[] = {
    {"dtau_dq", "rnea", "tau", "q"},   {"dtau_dv", "rnea", "tau", "v"},
    {"dqdd_dq", "aba", "qdd", "q"},    {"dqdd_dv", "aba", "qdd", "v"},
    {"dd_dq", "difference", "d", "q"}, {"dd_dq1", "difference", "d", "q1"},
};

/// q (+) v in the tangent spaces: of difference(q_next, .) at q_next.
Eigen::MatrixXd integrate_derivative(const Setup& setup, const Arguments<double>& in,
                                     const std::string& with) {
  const Reference reference(setup.model);
  const ComplexReference complex(setup.model);
  const VectorOf<Complex> next = reference.integrate(in.at("q"), in.at("v")).cast<Complex>();
  Arguments<Complex> at;
  for (const auto& [name, x] : in) at[name] = x.cast<Complex>();
  Eigen::MatrixXd J(setup.nv, setup.nv);
  for (int j = 0; j < setup.nv; ++j) {
    const VectorOf<Complex> step =
        VectorOf<Complex>::Unit(setup.nv, j) * Complex(0, complex_step::kStep);
    const Arguments<Complex> there = moved(complex, at, with, step);
    J.col(j) = complex.difference(next, complex.integrate(there.at("q"), there.at("v"))).imag() /
               complex_step::kStep;
  }
  return J;
}

Results results_of(const Request& request, const Signature& s, const Setup& setup,
                   const Arguments<double>& in) {
  const Request definition = defined_as(request);
  if (definition.derivative != Derivative::kNone) return derived(definition, s, setup, in);
  const std::string& function = request.function;
  Results results;
  if (function == "integrate_derivatives") {
    results["dq_next_dq"] = known(integrate_derivative(setup, in, "q"));
    results["dq_next_dv"] = known(integrate_derivative(setup, in, "v"));
    return results;
  }
  const bool derivatives = function.ends_with("_derivatives");
  const Arguments<double> values = derivatives ? Arguments<double>() : plain(function, setup, in);
  for (const Argument& output : s.outputs) {
    const auto by_name = values.find(output.name);
    if (by_name != values.end()) results[output.name] = known_by_rows(by_name->second, output);
    for (const Part& part : kParts)
      if (derivatives && output.name == part.output)
        results[output.name] =
            jacobian(std::make_shared<Derivatives>(setup, part.function, part.of, in), part.with);
    for (const auto& [name, of] : {std::pair{"M", "crba"}, {"Minv", "minv"}})
      if (derivatives && output.name == name)
        results[output.name] = known_by_rows(plain(of, setup, in).at(name), output);
  }
  return results;
}

Arguments<double> inputs_of(const Signature& s, const Values& inputs) {
  Arguments<double> in;
  for (const Argument& a : s.inputs) {
    const auto& x = inputs.at(a.name);
    in[a.name] = Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
  }
  return in;
}

/// Within +-1, of size 1/2 at least: what NAME_selftest.cpp has.  A step of splitmix64.
double weight(std::uint64_t projection, std::uint64_t side, std::uint64_t i) {
  std::uint64_t z = (2 * (kProjections * i + projection) + side + 1) * 0x9E3779B97F4A7C15u;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  z ^= z >> 31;
  const double size = 0.5 + static_cast<double>(z >> 11) * 0x1p-54;
  return z & 1 ? size : -size;
}

Vector weights(std::uint64_t projection, std::uint64_t side, Eigen::Index n) {
  Vector w(n);
  for (Eigen::Index i = 0; i < n; ++i)
    w[i] = weight(projection, side, static_cast<std::uint64_t>(i));
  return w;
}

}  // namespace

Values evaluate_reference(const Request& request, const Setup& setup, const Values& inputs) {
  const Signature s = signature(request, setup);
  Values values;
  for (const auto& [name, result] : results_of(request, s, setup, inputs_of(s, inputs))) {
    const Vector y = by_rows<double>(result.whole());
    values[name] = {y.begin(), y.end()};
  }
  return values;
}

Values evaluate_projections(const Request& request, const Setup& setup, const Values& inputs) {
  const Signature s = signature(request, setup);
  const Results results = results_of(request, s, setup, inputs_of(s, inputs));
  Values values;
  for (const Argument& output : s.outputs)
    for (std::uint64_t k = 0; k < kProjections; ++k)
      values[output.name].push_back(
          results.at(output.name)
              .projection(weights(k, 0, output.rows),
                          weights(k, output.symmetric ? 0 : 1, output.cols)));
  return values;
}

}  // namespace arboc

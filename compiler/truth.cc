#include "truth.h"

#include <cmath>
#include <functional>
#include <optional>

#include "functions/derived_signature.h"
#include "reference/differentiate.h"
#include "truth_plain.h"

namespace arboc {
namespace {

using truth::Arguments;
using truth::by_rows;
using truth::moved;
using truth::plain;
using truth::Plain;

/// What the entries of an output are multiplied with before they are added.
struct Weight {
  std::function<Eigen::VectorXd(const Arguments<Complex>&)> at;
  bool constant = true;
};

/// Derivatives of one output.
class Derivatives {
 public:
  Derivatives(const Setup& setup, std::string function, std::string output,
              const Arguments<double>& in)
      : setup_(setup),
        function_(std::move(function)),
        output_(std::move(output)),
        at_(setup.model) {
    for (const auto& [name, x] : in) in_[name] = x.cast<Complex>();
    if (setup.parameters.empty()) engine_.emplace(setup, setup.model);
  }

  int size(const std::string& input) const {
    return input == "q" || input == "q1" ? setup_.nv : static_cast<int>(in_.at(input).size());
  }
  Eigen::VectorXd value() const { return evaluate(in_).at(output_).real(); }

  /// Entries of the output x size(input).
  Eigen::MatrixXd jacobian(const std::string& input) const { return jacobian(in_, input); }

  /// Entry (j, k): along j of x, then along k of y, of weight^T output.
  Eigen::MatrixXd hessian(const std::string& x, const std::string& y, const Weight& weight,
                          bool symmetric) const {
    const int n = size(x), m = size(y);
    Eigen::MatrixXd H(n, m);
    const bool exact = weight.constant && quadratic(y);
    const double h = exact ? 1 : step(y);
    for (int k = 0; k < m; ++k) {
      const auto slopes = [&](int times) -> Eigen::VectorXd {
        const VectorOf<Complex> outer = VectorOf<Complex>::Unit(m, k) * Complex(times * h);
        if (symmetric && x == y) return along_with(x, outer, k + 1, weight);
        const Arguments<Complex> there = moved(at_, in_, y, outer);
        return jacobian(there, x).transpose() * weight.at(there);
      };
      if (exact)
        H.col(k) = (slopes(1) - slopes(-1)) / 2;
      else
        H.col(k) = (45 * (slopes(1) - slopes(-1)) - 9 * (slopes(2) - slopes(-2)) +
                    (slopes(3) - slopes(-3))) /
                   (60 * h);
    }
    if (symmetric && x == y) H.triangularView<Eigen::StrictlyLower>() = H.transpose();
    return H;
  }
  const Arguments<Complex>& inputs() const { return in_; }
  Eigen::VectorXd value(const Arguments<Complex>& in) const {
    return evaluate(in).at(output_).real();
  }

 private:
  Arguments<Complex> evaluate(const Arguments<Complex>& in) const {
    return engine_ ? (*engine_)(function_, in) : plain(function_, setup_, in);
  }
  bool analytic(const std::string& input) const {
    if (input == "f_ext") return false;
    for (const Parameter& p : setup_.parameters)
      if (input == p.name) return false;
    return true;
  }
  /// The output, and its derivatives by other inputs, are polynomials of degree two at most in this
  /// input, so that a central difference of any length is exact.
  bool quadratic(const std::string& input) const {
    if (function_ == "integrate" || function_ == "difference") return false;
    return input == "a" || input == "tau" || (input == "v" && !setup_.joint_forces.friction);
  }
  /// Results are linear in wrenches and gravity: a long step leaves the least noise.
  double step(const std::string& input) const {
    if (input == "f_ext" || input == "gravity") return 1;
    return analytic(input) ? complex_step::difference_step(at_) : 1e-3;
  }

  Eigen::MatrixXd jacobian(const Arguments<Complex>& in, const std::string& input) const {
    const int n = size(input);
    Eigen::MatrixXd J;
    for (int j = 0; j < n; ++j) {
      const Eigen::VectorXd column = derivative(in, input, VectorOf<Complex>::Unit(n, j));
      if (j == 0) J.resize(column.size(), n);
      J.col(j) = column;
    }
    return J;
  }

  Eigen::VectorXd derivative(const Arguments<Complex>& in, const std::string& input,
                             const VectorOf<Complex>& direction) const {
    if (analytic(input)) {
      const VectorOf<Complex> inner = direction * Complex(0, complex_step::kStep);
      return evaluate(moved(at_, in, input, inner)).at(output_).imag() / complex_step::kStep;
    }
    const double h = step(input);
    const auto f = [&](int times) -> Eigen::VectorXd {
      return value(moved<Complex>(at_, in, input, direction * Complex(times * h)));
    };
    return (45 * (f(1) - f(-1)) - 9 * (f(2) - f(-2)) + (f(3) - f(-3))) / (60 * h);
  }

  /// The first n entries of the gradient with respect to d of weight^T f(x (+) d) at d = outer.
  Eigen::VectorXd along_with(const std::string& x, const VectorOf<Complex>& outer, int n,
                             const Weight& weight) const {
    const Eigen::Index all = outer.size();
    const Eigen::VectorXd w = weight.at(moved(at_, in_, x, outer));
    Eigen::VectorXd result = Eigen::VectorXd::Zero(all);
    for (Eigen::Index j = 0; j < n; ++j) {
      const VectorOf<Complex> unit = VectorOf<Complex>::Unit(all, j);
      if (!analytic(x)) {
        result[j] = w.dot(derivative(moved(at_, in_, x, outer), x, unit));
        continue;
      }
      const VectorOf<Complex> both = outer + unit * Complex(0, complex_step::kStep);
      result[j] = w.dot(Eigen::VectorXd(evaluate(moved(at_, in_, x, both)).at(output_).imag() /
                                        complex_step::kStep));
    }
    return result;
  }

  const Setup& setup_;
  std::string function_, output_;
  Arguments<Complex> in_;
  ComplexReference at_;                   ///< for its manifold
  std::optional<Plain<Complex>> engine_;  ///< where no parameter changes it
};

std::vector<double> list(const Eigen::VectorXd& x) { return {x.begin(), x.end()}; }

/// An output of one of the functions *_derivatives.
Eigen::VectorXd value_of_derivative(const Request& request, const Setup& setup,
                                    const Arguments<double>& in) {
  Values inputs;
  for (const auto& [name, x] : in) inputs[name] = list(x);
  const Values outputs = evaluate_reference(Request{request.function}, setup, inputs);
  const std::vector<double>& y = outputs.at(request.output);
  return Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
}

/// Its Jacobian: differences of complex steps.
Eigen::MatrixXd jacobian_of_derivative(const Request& request, const Setup& setup,
                                       const Arguments<double>& in, const std::string& with) {
  const Reference reference(setup.model);
  const auto value = [&](const Arguments<double>& at) {
    return value_of_derivative(request, setup, at);
  };
  const bool on_manifold = with == "q" || with == "q1";
  const Eigen::Index n = on_manifold ? setup.nv : in.at(with).size();
  const double h = complex_step::difference_step(ComplexReference(setup.model));
  Eigen::MatrixXd J;
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto odd = [&](int m) -> Eigen::VectorXd {
      const Eigen::VectorXd step = m * h * Eigen::VectorXd::Unit(n, j);
      return value(moved<double>(reference, in, with, step)) -
             value(moved<double>(reference, in, with, -step));
    };
    const Eigen::VectorXd column = (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h);
    if (j == 0) J.resize(column.size(), n);
    J.col(j) = column;
  }
  return J;
}

Values derived(const Request& request, const Signature& s, const Setup& setup,
               const Arguments<double>& in) {
  const Derivatives of(setup, request.function, request.output, in);
  Request base;
  base.function = request.function;
  const std::vector<std::string> with = derived_inputs(request, signature(base, setup));
  const auto lambda = in.find("lambda");
  const bool twice = request.function.ends_with("_derivatives");
  const Weight weight{[&](const Arguments<Complex>& at) -> Eigen::VectorXd {
                        if (request.squares)
                          return 2 *
                                 (twice ? value_of_derivative(request, setup, in) : of.value(at));
                        if (lambda != in.end() && lambda->second.size() > 0) return lambda->second;
                        return Eigen::VectorXd::Ones(1);
                      },
                      !request.squares};
  Values values;
  if (request.derivative != Derivative::kHessian) {
    for (size_t k = 0; k < with.size(); ++k) {
      const Eigen::MatrixXd J =
          twice ? jacobian_of_derivative(request, setup, in, with[k]) : of.jacobian(with[k]);
      values[s.outputs[k].name] = request.derivative == Derivative::kJacobian
                                      ? list(by_rows<double>(J))
                                      : list(J.transpose() * weight.at(of.inputs()));
    }
    return values;
  }
  for (const Argument& output : s.outputs)
    for (const std::string& x : with)
      for (const std::string& y : with)
        if (output.name == "H_" + x + y)
          values[output.name] = list(by_rows<double>(of.hessian(x, y, weight, !setup.iterated)));
  return values;
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

}  // namespace

Values evaluate_reference(const Request& request, const Setup& setup, const Values& inputs) {
  const Signature s = signature(request, setup);
  Arguments<double> in;
  for (const Argument& a : s.inputs) {
    const auto& x = inputs.at(a.name);
    in[a.name] = Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  }
  const Request definition = defined_as(request);
  if (definition.derivative != Derivative::kNone) return derived(definition, s, setup, in);
  const std::string& function = request.function;
  Values values;
  if (function == "integrate_derivatives") {
    values["dq_next_dq"] = list(by_rows<double>(integrate_derivative(setup, in, "q")));
    values["dq_next_dv"] = list(by_rows<double>(integrate_derivative(setup, in, "v")));
    return values;
  }
  if (!function.ends_with("_derivatives")) {
    for (const auto& [name, x] : plain(function, setup, in)) values[name] = list(x);
    return values;
  }
  for (const Argument& output : s.outputs) {
    for (const Part& part : kParts)
      if (output.name == part.output)
        values[output.name] = list(
            by_rows<double>(Derivatives(setup, part.function, part.of, in).jacobian(part.with)));
    if (output.name == "M") values["M"] = list(plain("crba", setup, in).at("M"));
    if (output.name == "Minv") values["Minv"] = list(plain("minv", setup, in).at("Minv"));
  }
  return values;
}

}  // namespace arboc

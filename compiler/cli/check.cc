// arboc check MODEL: generated code against the reference engine and against differences.
//
// Differences: the power of the joint forces is the rate of the energy, v tau = d/dt (T + V), taken
// from the reference's energies by a five-point stencil along the motion q(t) = q (+) (v t + a
// t^2/2).
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "cli/build.h"
#include "cli/common.h"
#include "state_source.h"
#include "truth.h"

namespace arboc::cli {
namespace {

using Vector = Eigen::VectorXd;

Vector vector(const std::vector<double>& x) {
  return Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// Largest difference relative to the largest entry, or to `scale` if that is more.
double relative_error(const std::vector<double>& got, const std::vector<double>& expected,
                      double scale) {
  double error = 0;
  for (size_t i = 0; i < expected.size(); ++i) {
    if (!(std::fabs(got[i] - expected[i]) <= error)) error = std::fabs(got[i] - expected[i]);
    scale = std::max(scale, std::fabs(expected[i]));
  }
  return error / std::max(scale, 1e-9);
}

/// f'(0) by a five-point stencil.
template <class F>
double derivative(const F& f, double h) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}

/// d/dt (T + V) along the motion (v, a) through q.
double power(const Reference& reference, const Vector& q, const Vector& v, const Vector& a) {
  const auto energy = [&](double t) {
    const Vector at = reference.integrate(q, t * v + 0.5 * t * t * a);
    return reference.kinetic(at, v + t * a) + reference.potential(at);
  };
  // Forward dynamics of light links can ask for large accelerations: shorter steps then.
  return derivative(energy, 1e-3 / (1 + 0.01 * a.cwiseAbs().maxCoeff()));
}

/// v y against differences, relative to the sizes that meet in it; nothing for functions without.
std::optional<double> difference_error(const std::string& function, const Reference& reference,
                                       const State& s, const Values& results) {
  const Vector zero = Vector::Zero(s.v.size());
  const auto compare = [&](const Vector& force, double rate) {
    return std::fabs(s.v.dot(force) - rate) /
           (s.v.cwiseAbs().dot(force.cwiseAbs()) + std::fabs(rate) + 1e-9);
  };
  const auto matrix = [&](const char* name) {
    const Vector entries = vector(results.at(name));
    return Eigen::Map<const Eigen::MatrixXd>(entries.data(), s.v.size(), s.v.size()).eval();
  };
  if (function == "rnea")
    return compare(vector(results.at("tau")), power(reference, s.q, s.v, s.a));
  if (function == "nle")
    return compare(vector(results.at("nle")), power(reference, s.q, s.v, zero));
  if (function == "aba")
    return compare(s.tau, power(reference, s.q, s.v, vector(results.at("qdd"))));
  if (function == "gravity") {
    const auto potential = [&](double t) {
      return reference.potential(reference.integrate(s.q, t * s.v));
    };
    return compare(vector(results.at("g")), derivative(potential, 1e-3));
  }
  const auto inertial = [&](const Vector& a) {
    return power(reference, s.q, s.v, a) - power(reference, s.q, s.v, zero);
  };
  if (function == "crba" || function == "rnea_derivatives")
    return compare(matrix("M") * s.a, inertial(s.a));
  if (function == "minv") return compare(s.a, inertial(matrix("Minv") * s.a));
  return std::nullopt;
}

double condition(const Eigen::MatrixXd& M) {
  const Vector eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues();
  return eigenvalues.maxCoeff() / eigenvalues.minCoeff();
}

/// Random inputs of a function; weights too.
Values inputs_of(const Signature& s, const Setup& setup, StateSource& source) {
  Values in = source.inputs(setup);
  for (const Argument& a : s.inputs)
    if (a.name == "lambda") in["lambda"] = source.vector(a.rows);
  return in;
}

double largest_entry(const Values& values) {
  double largest = 0;
  for (const auto& [name, list] : values)
    for (const double x : list) largest = std::max(largest, std::fabs(x));
  return largest;
}

struct Worst {
  double error = 0, allowed = 0, ratio = -1;
  std::optional<double> differences;

  void add(double e, double limit) {
    if (e / limit <= ratio) return;
    error = e;
    allowed = limit;
    ratio = e / limit;
    if (std::isnan(e)) ratio = 1e300;
  }
};

}  // namespace

int run_check(const Common& common, int states) {
  CompileOptions options = common.compile;
  options.requests = requests(common);
  const Compilation compilation = compiled(common, options);
  const Setup& setup = compilation.setup;
  const GeneratedCode code(common, target(compilation, options));
  const Reference reference(setup.model, setup.joint_forces);
  fmt::print("{} random states; error relative to the largest entry of each state's result\n",
             states);
  fmt::print("{:<30} {:>16} {:>9} {:>18} {:>9}\n", "function", "against reference", "allowed",
             "against differences", "allowed");
  constexpr double kDifferences = 1e-6;
  bool agree = true;
  for (const CompiledFunction& f : compilation.functions) {
    const std::string& function = f.signature.name;
    StateSource source(3);
    Worst worst;
    const bool solves = !f.signature.positive.empty() || f.request.function == "aba";
    // The balance of power knows nothing of wrenches, friction and other parameters.
    const bool comparable =
        setup.loads.empty() && setup.parameters.empty() && !setup.joint_forces.any();
    for (int k = 0; k < states; ++k) {
      check_interrupt();
      const Values in = inputs_of(f.signature, setup, source);
      const Values got = code.call(function, in);
      const Values expected = evaluate_reference(f.request, setup, in);
      // Solving amplifies rounding by the condition of M.
      const double amplified =
          solves ? std::max(1.0, condition(reference.crba(vector(in.at("q")))) / 1e4) : 1;
      for (const Argument& a : f.signature.outputs)
        worst.add(relative_error(got.at(a.name), expected.at(a.name),
                                 a.tolerance == kDifferencedTwice ? largest_entry(expected) : 0),
                  a.tolerance * amplified);
      if (!comparable) continue;
      const State s{vector(in.at("q")), vector(in.at("v")), vector(in.at("a")),
                    vector(in.at("tau"))};
      if (const auto e = difference_error(function, reference, s, got))
        worst.differences = std::isnan(*e) ? *e : std::max(worst.differences.value_or(0), *e);
    }
    const bool good =
        worst.ratio <= 1 && !(worst.differences && !(*worst.differences <= kDifferences));
    agree = agree && good;
    fmt::print("{:<30} {:>17.1e} {:>9.0e} {:>19} {:>9} {}\n", function, worst.error, worst.allowed,
               worst.differences ? fmt::format("{:.1e}", *worst.differences) : "-",
               worst.differences ? fmt::format("{:.0e}", kDifferences) : "", good ? "ok" : "WRONG");
  }
  flush_stdout();
  if (!agree) fmt::print(stderr, "error: the generated code disagrees\n");
  return agree ? kOk : kNo;
}

}  // namespace arboc::cli

#include "functions/derived_signature.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/diagnostic.h"
#include "base/words.h"
#include "functions/arguments.h"

namespace arboc {
namespace {

/// What a derivative is taken of.
std::string value_of(const Request& request, const Argument& of) {
  if (request.squares) return fmt::format("{0}^T {0}", of.name);
  const bool weighted = request.derivative == Derivative::kHessian && of.rows * of.cols > 1;
  return weighted || request.derivative == Derivative::kVjp ? "lambda^T " + of.name : of.name;
}

/// Configurations move in their tangent space.
std::string by(const std::string& input) {
  return input == "q" || input == "q1" ? fmt::format("d of {} (+) d", input) : input;
}

/// (N m, N) / (rad, m): of a value, or its square, by an input.
std::string quotient(const std::string& unit, const std::vector<std::string>& by) {
  const auto factor = [](const std::string& u) {
    return u.find_first_of(" ,/") == std::string::npos ? u : "(" + u + ")";
  };
  std::string out = factor(unit);
  for (const std::string& u : by) out += " / " + factor(u);
  return out;
}
std::string unit_of(const Request& request, const Argument& of) {
  return request.squares ? "(" + of.unit + ")^2" : of.unit;
}

Argument first_derivative(const Request& request, const Argument& of, const Argument& input,
                          int size) {
  Argument out;
  out.rows = size;
  out.unit = quotient(unit_of(request, of), {input.unit});
  out.meaning =
      fmt::format("derivative of {} with respect to {}", value_of(request, of), by(input.name));
  // The reference engine has exact first derivatives of plain functions only.
  out.tolerance = request.function.ends_with("_derivatives") ? kDifferencedTwice : 1e-11;
  if (request.derivative != Derivative::kJacobian) {
    out.name = (request.derivative == Derivative::kGradient ? "grad_" : "vjp_") + input.name;
    return out;
  }
  if (of.cols > 1) out.meaning += fmt::format("; a row an entry of {}, by rows", of.name);
  out.name = fmt::format("d{}_d{}", of.name, input.name);
  out.rows = of.rows * of.cols;
  out.cols = size;
  out.sparse = true;
  return out;
}

/// The reference engine takes differences along numbers of the model and wrenches, of second
/// derivatives differences of differences.
bool differenced(const std::string& input) {
  return input != "q" && input != "v" && input != "a" && input != "tau" && input != "q1";
}

Argument second_derivative(const Request& request, const Argument& of, const Argument& x,
                           const Argument& y) {
  Argument H;
  H.name = fmt::format("H_{}{}", x.name, y.name);
  H.unit = quotient(unit_of(request, of), {x.unit, y.unit});
  H.meaning =
      fmt::format("second derivative of {} with respect to {}", value_of(request, of),
                  x.name == y.name ? by(x.name) + ", twice" : by(x.name) + " and " + by(y.name));
  H.sparse = true;
  H.tolerance = differenced(x.name) && differenced(y.name) ? kDifferencedTwice : 1e-9;
  return H;
}

}  // namespace

std::vector<std::string> derived_inputs(const Request& request, const Signature& s) {
  if (!request.with.empty()) return request.with;
  std::vector<std::string> names;
  for (const Argument& a : s.inputs)
    if (a.name != "lambda") names.push_back(a.name);
  return names;
}

const Argument& named(const std::vector<Argument>& arguments, const std::string& name,
                      const Request& request, const char* what) {
  for (const Argument& a : arguments)
    if (a.name == name) return a;
  std::vector<std::string_view> names;
  for (const Argument& a : arguments) names.emplace_back(a.name);
  throw UsageError(
      unknown(text(request), fmt::format("{} has no {}", request.function, what), name, names));
}

/// Each input by which a derivative is taken is there, once.
size_t output_index(const Signature& s, const std::string& name) {
  size_t k = 0;
  while (s.outputs.at(k).name != name) ++k;
  return k;
}

void check_inputs(const Request& request, const Signature& s) {
  for (const std::string& input : request.with) {
    named(s.inputs, input, request, "input");
    if (std::count(request.with.begin(), request.with.end(), input) > 1)
      throw UsageError(
          fmt::format("{}: input '{}' is given twice", text(request), printable(input)));
  }
}

void add_derivatives(const Request& request, const Setup& setup, const Argument& of, Signature& s) {
  const std::vector<Argument> inputs = s.inputs;
  const std::vector<std::string> with = derived_inputs(request, s);
  const int entries = of.rows * of.cols;
  const bool scalar = request.squares || entries == 1;
  const auto input = [&](const std::string& name) { return named(inputs, name, request, "input"); };
  const auto size = [&](const std::string& name) { return tangent_size(input(name), setup); };
  if (request.derivative == Derivative::kVjp ||
      (request.derivative == Derivative::kHessian && !scalar))
    s.inputs.push_back(
        {"lambda", entries, 1, "1",
         fmt::format("weights of the entries of {}{}", of.name, of.cols > 1 ? ", by rows" : "")});
  if (request.derivative == Derivative::kGradient && !scalar)
    throw UsageError(
        fmt::format("{}: {} has {} entries: ask for its --vjp, or for {}^2, the sum of its squares",
                    text(request), of.name, entries, of.name));
  for (size_t i = 0; i < with.size(); ++i) {
    if (request.derivative != Derivative::kHessian) {
      s.outputs.push_back(first_derivative(request, of, input(with[i]), size(with[i])));
      continue;
    }
    for (size_t j = i; j < with.size(); ++j) {
      Argument H = second_derivative(request, of, input(with[i]), input(with[j]));
      H.rows = size(with[i]);
      H.cols = size(with[j]);
      H.symmetric = i == j && !setup.iterated;
      s.outputs.push_back(H);
    }
  }
}

std::string meaning_of(const Request& request, const Signature& base, const Argument& of,
                       bool iterated) {
  const char* kind = request.derivative == Derivative::kJacobian  ? "Jacobian"
                     : request.derivative == Derivative::kHessian ? "Second derivatives"
                                                                  : "Gradient";
  const std::string value = value_of(request, of);
  return fmt::format("{} of {}{} of {}{} with respect to {}{}.", kind, value,
                     value == of.name ? "" : ", " + of.name, request.function,
                     value == of.name ? "" : ",", fmt::join(derived_inputs(request, base), ", "),
                     iterated && request.derivative == Derivative::kHessian
                         ? "; derivatives of derivatives along the body's axes"
                         : "");
}

}  // namespace arboc

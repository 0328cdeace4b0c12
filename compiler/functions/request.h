// What is asked for: a function of the catalogue, or a derivative of one of its outputs.
//
//   rnea                        rnea
//   jacobian  rnea.tau:q,v      derivative of tau with respect to q and v
//   gradient  energy.V:q        of an output of one entry; rnea.tau^2 is the sum of its squares
//   vjp       rnea.tau:q,v,a    lambda^T times the Jacobian, lambda an input
//   hessian   rnea.tau:q,v      second derivative of lambda^T tau, or of an output of one entry
// Without a list the derivative is taken with respect to every input.
#pragma once
#include <string>
#include <vector>

namespace arboc {

enum class Derivative { kNone, kJacobian, kGradient, kVjp, kHessian };

struct Request {
  std::string function;  ///< name in the catalogue
  Derivative derivative = Derivative::kNone;
  std::string output{};             ///< of which
  bool squares = false;             ///< of the sum of its squares
  std::vector<std::string> with{};  ///< names of inputs; empty: all
};

/// Reads `rnea.tau^2:q,v`.  Throws UsageError that begins with `option` and says the form; whether
/// function, output and inputs exist is seen by signature().
Request parse_request(const std::string& option, Derivative derivative, const std::string& text);

/// The name of the generated function: rnea, rnea_tau_jacobian, rnea_tau2_gradient_q.
std::string name(const Request& request);

/// As on the command line: `rnea`, `--jacobian rnea.tau:q`.
std::string text(const Request& request);

}  // namespace arboc

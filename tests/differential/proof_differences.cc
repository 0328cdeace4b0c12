#include "differential/proof_differences.h"

#include <cmath>

#include "functions/derived_signature.h"

namespace arboc::test {
namespace {

/// Functions of the catalogue that are Jacobians with names of their own.
struct Part {
  const char *function, *output, *of, *value, *with;
};
constexpr Part kParts[] = {
    {"rnea_derivatives", "dtau_dq", "rnea", "tau", "q"},
    {"rnea_derivatives", "dtau_dv", "rnea", "tau", "v"},
    {"rnea_derivatives", "M", "rnea", "tau", "a"},
    {"aba_derivatives", "dqdd_dq", "aba", "qdd", "q"},
    {"aba_derivatives", "dqdd_dv", "aba", "qdd", "v"},
    {"aba_derivatives", "Minv", "aba", "qdd", "tau"},
    {"difference_derivatives", "dd_dq", "difference", "d", "q"},
    {"difference_derivatives", "dd_dq1", "difference", "d", "q1"},
};

/// y along a direction, and what is said of its derivative.
class Along {
 public:
  Along(ProofEngine& f, const Request& request, const Reference& reference, const Values& in,
        const Values& got, StateSource& source)
      : f_(f), request_(defined_as(request)), reference_(reference), in_(in), got_(got) {
    for (const Part& part : kParts)
      if (request.function == part.function && request.derivative == Derivative::kNone) {
        request_.function = part.of;
        request_.output = part.value;
        request_.with.emplace_back(part.with);
        outputs_.emplace_back(part.output);
      }
    if (request_.output.empty()) return;
    request_.with = derived_inputs(request_, signature({request_.function}, f.setup()));
    for (const std::string& input : request_.with) {
      // Small enough that masses and moments of inertia stay positive.
      const bool tangent = input == "q" || input == "q1";
      const int n = tangent ? f.setup().nv : static_cast<int>(in.at(input).size());
      direction_[input] = as_vector(source.vector(n, is_parameter(input) ? 0.02 : 1));
    }
  }

  std::optional<double> error() const {
    if (request_.output.empty()) return std::nullopt;
    if (request_.derivative == Derivative::kHessian)
      return f_.setup().iterated ? std::nullopt : std::optional(apart(second(), curvature()));
    return apart(first(), slope());
  }

 private:
  bool is_parameter(const std::string& input) const {
    for (const Parameter& p : f_.setup().parameters)
      if (p.name == input) return true;
    return false;
  }

  VectorXd value(double t) const {
    Values at = in_;
    for (const auto& [input, direction] : direction_)
      at = displaced(reference_, at, input, t * direction);
    const VectorXd y = as_vector(f_({request_.function}, at).at(request_.output));
    if (request_.squares) return VectorXd::Constant(1, y.squaredNorm());
    const bool weighted = request_.derivative == Derivative::kVjp ||
                          (request_.derivative == Derivative::kHessian && y.size() > 1);
    return weighted ? VectorXd::Constant(1, y.dot(as_vector(in_.at("lambda")))) : y;
  }

  VectorXd slope() const {
    const double h = 3e-3;
    const auto odd = [&](int k) -> VectorXd { return value(k * h) - value(-k * h); };
    return (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h);
  }
  VectorXd curvature() const {
    const double h = 1e-2;
    const auto even = [&](int k) -> VectorXd { return value(k * h) + value(-k * h); };
    return (270 * even(1) - 27 * even(2) + 2 * even(3) - 490 * value(0)) / (180 * h * h);
  }

  VectorXd first() const {
    VectorXd sum;
    const bool matrix = !outputs_.empty() || request_.derivative == Derivative::kJacobian;
    for (size_t k = 0; k < request_.with.size(); ++k) {
      const std::string& with = request_.with[k];
      const VectorXd& d = direction_.at(with);
      const std::string prefix = request_.derivative == Derivative::kGradient ? "grad_"
                                 : request_.derivative == Derivative::kVjp
                                     ? "vjp_"
                                     : "d" + request_.output + "_d";
      const auto& entries = got_.at(outputs_.empty() ? prefix + with : outputs_[k]);
      const auto rows = static_cast<Eigen::Index>(entries.size()) / d.size();
      const VectorXd part = as_matrix(entries, matrix ? rows : 1) * d;
      sum = k == 0 ? part : VectorXd(sum + part);
    }
    return sum;
  }

  /// Blocks that are not an output are zero.
  VectorXd second() const {
    double sum = 0;
    for (const auto& x : request_.with)
      for (const auto& y : request_.with) {
        const auto H = got_.find("H_" + x + y);
        if (H == got_.end()) continue;
        const VectorXd &dx = direction_.at(x), &dy = direction_.at(y);
        sum += (x == y ? 1 : 2) * dx.dot(as_matrix(H->second, dx.size()) * dy);
      }
    return VectorXd::Constant(1, sum);
  }

  ProofEngine& f_;
  Request request_;
  const Reference& reference_;
  const Values& in_;
  const Values& got_;
  std::vector<std::string> outputs_;  ///< of kParts
  std::map<std::string, VectorXd> direction_;
};

}  // namespace

std::optional<double> difference_error(ProofEngine& f, const Request& request,
                                       const Reference& reference, const Values& in,
                                       const Values& got, StateSource& source) {
  return Along(f, request, reference, in, got, source).error();
}

}  // namespace arboc::test

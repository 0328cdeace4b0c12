#include "functions/recursion.h"

#include <algorithm>

#include "functions/catalogue.h"
#include "functions/derived_signature.h"

namespace arboc {
namespace {

const std::vector<JacobianRecursion>& table() {
  static const std::vector<JacobianRecursion::Column> inverse{
      {"q", "dtau_dq"}, {"v", "dtau_dv"}, {"a", "M"}};
  static const std::vector<JacobianRecursion> all{
      {"rnea.tau", "rnea_derivatives", inverse, true},
      {"nle.nle", "rnea_derivatives", inverse, true},
      {"statics.tau", "rnea_derivatives", inverse, true},
      {"gravity.g", "rnea_derivatives", inverse, true},
      {"aba.qdd", "aba_derivatives", {{"q", "dqdd_dq"}, {"v", "dqdd_dv"}, {"tau", "Minv"}}},
  };
  return all;
}

}  // namespace

std::string JacobianRecursion::output(const std::string& input) const {
  for (const Column& column : columns)
    if (input == column.input) return column.output;
  return "";
}

const JacobianRecursion* recursion_of(const Request& request, const Setup& setup) {
  const Request r = defined_as(request);
  if (r.derivative != Derivative::kJacobian) return nullptr;
  // Gravity alone has no springs, which the recursion would add.
  if (r.function == "gravity" && setup.joint_forces.stiffness) return nullptr;
  const std::vector<std::string> with = derived_inputs(r, signature(Request{r.function}, setup));
  for (const JacobianRecursion& recursion : table()) {
    const auto has = [&](const std::string& input) {
      return input == "f_ext" ? recursion.wrenches : !recursion.output(input).empty();
    };
    if (recursion.of == r.function + "." + r.output && std::all_of(with.begin(), with.end(), has))
      return &recursion;
  }
  return nullptr;
}

}  // namespace arboc

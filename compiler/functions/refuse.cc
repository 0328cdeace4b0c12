#include "functions/refuse.h"

#include <fmt/format.h>

#include <algorithm>

#include "algorithms/com.h"
#include "base/diagnostic.h"
#include "functions/trace.h"

namespace arboc {

void refuse_singular(const DynamicTree& tree, const std::vector<Expr>& pivots,
                     const std::string& function) {
  for (size_t k = pivots.size(); k-- > 0;) {
    if (!pivots[k].is_constant() || pivots[k].value() > 0) continue;
    const auto body = std::find_if(tree.body.begin(), tree.body.end(), [&](const Body& b) {
      const int first = b.v, last = b.v + freedoms(b.motion);
      return first <= static_cast<int>(k) && static_cast<int>(k) < last;
    });
    throw AbsentError(
        fmt::format("error: joint '{}': what it moves has no inertia about its axis, so {} has no "
                    "solution (give its links mass, fix the joint, or leave {} out)",
                    printable(body->joint), function, function));
  }
}

void refuse_massless(const DynamicTree& tree, const Setup& setup, const std::string& function) {
  if (function != "com" && function != "com_jacobian" && function != "centroidal") return;
  for (const Parameter& p : setup.parameters)
    if (p.kind == Parameter::Kind::kMass) return;
  if (total_mass<double>(tree) == 0)
    throw AbsentError(fmt::format(
        "error: nothing that moves has mass, so {} has no value (give links mass, or leave {} out)",
        function, function));
}

void refuse_dynamics(const Model& model, const std::string& function) {
  constexpr const char* kKinematic[] = {"fk",        "frame_",     "joint_jacobians",
                                        "integrate", "difference", "regressor"};
  if (!model.kinematic) return;
  for (const char* name : kKinematic)
    if (function.starts_with(name)) return;
  throw AbsentError(fmt::format(
      "error: the file gives no mass, cg and inertia of anything, so there is no {} (give them, or "
      "ask for fk, frame_jacobian and the like)",
      function));
}

}  // namespace arboc

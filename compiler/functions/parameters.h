// Numbers of the model that stay inputs of the generated functions.
#pragma once
#include <string>
#include <vector>

#include "graph/expr.h"
#include "model/model.h"
#include "tree/numbers.h"

namespace arboc {

/// One input of generated functions: `size` numbers of each of some links or joints.
struct Parameter {
  enum class Kind {
    kGravity,
    kMass,
    kCentre,
    kInertia,
    kLength,
    kNamedLength,
    kStiffness,
    kNeutral
  };
  Kind kind = Kind::kGravity;
  /// Of the input: gravity masses centres inertias lengths stiffness neutral.
  std::string name;
  std::string unit, meaning;
  /// Links (masses, centres, inertias), joints (lengths of placements, stiffness, neutral), or
  /// named lengths of the model (lengths, where it has any).
  std::vector<int> of;
  std::vector<std::string> labels;  ///< one an entry: `forearm.mass`
  std::vector<double> nominal;      ///< as the model has them, one an entry

  /// Numbers of each link or joint.
  int size() const;
};

/// `words`: gravity, masses, centres (or cgs), inertias, lengths, stiffness, neutral; with `:LINK`,
/// `:JOINT` or `:LENGTH` for that one only (several words of a group add up).  Throws UsageError.
std::vector<Parameter> resolve_parameters(const Model& model,
                                          const std::vector<std::string>& words);

/// The model's numbers with `values` (one vector a parameter) in their place.  S: double or Expr.
template <class S>
NumbersOf<S> numbers_with(const Model& model, const JointForces& forces,
                          const std::vector<Parameter>& parameters,
                          const std::vector<std::vector<S>>& values);

/// The model with other numbers; for the reference engine.
Model model_with(Model model, const std::vector<Parameter>& parameters,
                 const std::vector<std::vector<double>>& values);

}  // namespace arboc

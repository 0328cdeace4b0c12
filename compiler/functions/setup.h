// The body that functions are generated for: a configured model and the options they share,
// resolved.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "functions/parameters.h"
#include "model/model.h"
#include "tree/lower.h"

namespace arboc {

/// What can be left out to see what it is worth.
struct Simplifications {
  bool frames = true;   ///< both choices of frames are traced and the cheaper is kept
  bool regroup = true;  ///< inertial parameters move to where they need fewer operations
  bool fuse = true;     ///< sums of products become chains of fused multiply-adds
  bool limbs = true;    ///< isomorphic limbs go in the lanes of vectors where that pays
  bool dead = true;     ///< what no output needs is removed
};
/// Their names, for users.
inline constexpr std::pair<const char*, bool Simplifications::*> kSimplifications[] = {
    {"frames", &Simplifications::frames}, {"regroup", &Simplifications::regroup},
    {"fuse", &Simplifications::fuse},     {"dead", &Simplifications::dead},
    {"limbs", &Simplifications::limbs},
};

/// What the text is made for.
enum class Optimise {
  kSpeed,  ///< isomorphic limbs side by side in the lanes of vectors
  kSize,   ///< one after the other, by functions that they share
};

/// What all functions of one compilation share, as the user wrote it.
struct FunctionOptions {
  std::vector<std::string> frames;           ///< links; none: those that a joint moves
  Axes axes = Axes::kLocal;                  ///< of frame velocities, Jacobians and loads
  std::vector<std::string> external_forces;  ///< links on which wrenches act
  int transform_order = 1;                   ///< highest derivative of transforms, 0 to 3
  JointForces joint_forces;
  std::vector<std::string> parameters;  ///< `masses`, `lengths:forearm`, ...
  /// Hessians as derivatives of derivatives along the body's axes, not symmetric where a joint
  /// turns about several of them; otherwise second derivatives of f(q (+) d).
  bool iterated = false;
  Simplifications simplify;
  Optimise optimise = Optimise::kSpeed;
  int max_function_size = 250;  ///< operations after which emitted code begins another function
};

struct Setup {
  Model model;              ///< configured
  std::vector<int> frames;  ///< links that fk and frame functions report, in this order
  std::vector<int> loads;   ///< links on which external wrenches act
  std::vector<int> moving;  ///< links moved by a joint, in the order of the joints
  Axes axes = Axes::kLocal;
  int transform_order = 1;
  JointForces joint_forces;
  std::vector<Parameter> parameters;
  bool iterated = false;
  Simplifications simplify;
  Optimise optimise = Optimise::kSpeed;
  int max_function_size = 250;
  int nq = 0, nv = 0;
};

/// Throws UsageError for a name that the model has not, with the nearest one it has.
Setup resolve(Model model, const FunctionOptions& options = {});

/// The tree of the model's own numbers.
DynamicTree lower(const Setup& setup, const LoweringOptions& options);

}  // namespace arboc

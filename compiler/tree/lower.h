// Model -> DynamicTree: merge fixed joints, turn axes to z, choose frames, regroup inertias.
//
// Each step is value-preserving: tau, M and all their derivatives stay what they were up to
// rounding.  Steps and their order are those of docs/theory.md section 2.
#pragma once
#include <string>

#include "model/model.h"
#include "tree/dynamic_tree.h"
#include "tree/numbers.h"

namespace arboc {

enum class FrameChoice {
  kAxis,     ///< axes on z by signed permutations where possible; the link frames otherwise
  kDenavit,  ///< modified Denavit-Hartenberg frames along main children; leaves turned so that h_y
             ///< = 0
};

struct LoweringOptions {
  FrameChoice frames = FrameChoice::kAxis;
  /// Move inertial parameters that act like the parent's to the parent ([Khalil] base parameters).
  /// Keeps tau, M, their derivatives and qdd; link wrenches, energies of single links and centres
  /// of mass of fixed bases are no longer those of the bodies.
  bool regroup = false;
};

/// `model` is configured.  Never fails on a validated model.
DynamicTree lower(const Model& model, const LoweringOptions& options);

/// The same with `numbers` in place of the model's; frames are chosen for the model's own.  S is
/// double or Expr (compiled in functions/parameters.cc).
template <class S>
DynamicTreeOf<S> lower(const Model& model, const LoweringOptions& options,
                       const NumbersOf<S>& numbers);

/// The printed form (`--print=tree`): one line a body and one a frame.
std::string print(const DynamicTree& tree);

}  // namespace arboc

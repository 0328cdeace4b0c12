// The columns of the proof: small random bodies in which one type of joint stands in several
// places.  A new type is one more entry of kinds().
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "functions/setup.h"

namespace arboc::test {

struct Kind {
  enum class Special {
    kNone,
    kMimic,         ///< some joints follow others
    kMasslessLeaf,  ///< the last joint moves a link without inertia: no forward dynamics
  };
  const char* name;
  std::vector<JointType> types;  ///< of the joints; model `seed` begins with the seed-th
  Special special = Special::kNone;
};

const std::vector<Kind>& kinds();

/// Random axes, placements, inertias, gravity and branches; every joint has a spring, a damper,
/// friction and a rotor, for those who ask.
Model proof_model(const Kind& kind, Base base, std::uint64_t seed);

/// All types in one.
Kind mixed();

/// What the functions of a row are generated with, whatever the names of the model's links.
struct Variation {
  const char* name = "";
  bool loads = false;  ///< on the first link that moves and on the last
  bool joint_forces = false;
  bool iterated = false;
  Axes axes = Axes::kLocal;
  int transform_order = 1;
  std::vector<std::string> parameters{};
};

/// Frames are those of all links but the root.
Setup proof_setup(const Model& model, const Variation& variation);

}  // namespace arboc::test

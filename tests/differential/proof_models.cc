#include "differential/proof_models.h"

#include <algorithm>

#include "support/random.h"
#include "support/random_model.h"

namespace arboc::test {
namespace {

using Type = JointType;
using Special = Kind::Special;

/// Single joints of the type among revolute ones.
Kind often(const char* name, Type type) { return {name, {type, Type::kRevolute, type, type}}; }
/// One of the type, as they have several freedoms: first, inside or last, as the seed says.
Kind once(const char* name, Type type) { return {name, {type, Type::kRevolute, Type::kRevolute}}; }

void give_joint_forces(Model& model, Random& random) {
  for (Joint& joint : model.joints) {
    joint.damping = random.uniform(0, 2);
    joint.friction = random.uniform(0, 2);
    joint.stiffness = random.uniform(0, 20);
    joint.neutral = random.uniform(-1, 1);
    joint.rotor_inertia = random.uniform(0, 1);
  }
}

/// Of those that are free, the second follows the first, the last the second.
void make_followers(Model& model) {
  std::vector<int> single;
  for (size_t k = 0; k < model.joints.size(); ++k)
    if (nq(model.joints[k]) == 1 && !model.joints[k].mimic) single.push_back(static_cast<int>(k));
  const auto joint = [&](size_t k) -> Joint& {
    return model.joints[static_cast<size_t>(single[k])];
  };
  joint(1).mimic = Mimic{single[0], -1.5, 0.2};
  joint(single.size() - 1).mimic = Mimic{single[1], 0.7, -0.3};
}

void empty_last_link(Model& model) {
  model.links[static_cast<size_t>(model.joints.back().child)].inertial.reset();
}

}  // namespace

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all = {
      often("revolute", Type::kRevolute),
      often("continuous", Type::kContinuous),
      often("unbounded", Type::kUnbounded),
      often("prismatic", Type::kPrismatic),
      often("helical", Type::kHelical),
      once("universal", Type::kUniversal),
      once("multi-axis", Type::kMultiAxis),
      once("planar", Type::kPlanar),
      once("spherical", Type::kSpherical),
      once("floating", Type::kFloating),
      {"mimic",
       {Type::kRevolute, Type::kPrismatic, Type::kRevolute, Type::kHelical, Type::kRevolute},
       Special::kMimic},
      {"fixed", {Type::kFixed, Type::kRevolute, Type::kFixed, Type::kRevolute, Type::kFixed}},
      {"massless leaf",
       {Type::kRevolute, Type::kPrismatic, Type::kRevolute},
       Special::kMasslessLeaf},
  };
  return all;
}

Kind mixed() {
  return {"mixed",
          {Type::kRevolute, Type::kFixed, Type::kPlanar, Type::kSpherical, Type::kPrismatic,
           Type::kUnbounded, Type::kHelical, Type::kUniversal, Type::kFloating, Type::kContinuous},
          Special::kMimic};
}

Model proof_model(const Kind& kind, Base base, std::uint64_t seed) {
  RandomModelOptions options;
  options.base = base;
  options.mimic = options.massless = false;
  options.types = kind.types;
  const auto n = static_cast<std::ptrdiff_t>(kind.types.size());
  const auto shift = static_cast<std::ptrdiff_t>(seed - 1) % n;
  std::rotate(options.types.begin(), options.types.begin() + (n - shift) % n, options.types.end());
  Model model = random_model(seed, options);
  Random random(seed + 100);
  give_joint_forces(model, random);
  if (kind.special == Special::kMimic) make_followers(model);
  if (kind.special == Special::kMasslessLeaf) empty_last_link(model);
  return model;
}

Setup proof_setup(const Model& model, const Variation& variation) {
  FunctionOptions options;
  for (size_t k = 0; k < model.links.size(); ++k)
    if (static_cast<int>(k) != model.root) options.frames.push_back(model.links[k].name);
  options.axes = variation.axes;
  options.transform_order = variation.transform_order;
  options.iterated = variation.iterated;
  options.parameters = variation.parameters;
  if (variation.loads) {
    const std::vector<int> moving = resolve(model).moving;
    for (const int link : {moving.front(), moving.back()})
      options.external_forces.push_back(model.links[static_cast<size_t>(link)].name);
  }
  if (variation.joint_forces) {
    options.joint_forces = {true, true, true, true, 0.01};
    options.joint_forces.friction_velocity = 1;  // smooth enough for differences
  }
  return resolve(model, options);
}

}  // namespace arboc::test

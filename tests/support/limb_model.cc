#include "support/limb_model.h"

#include "support/random.h"

namespace arboc::test {
namespace {

Vector3<double> vector3(const Eigen::VectorXd& a) { return {a[0], a[1], a[2]}; }

/// Other numbers in the places of a limb's own; a third of the limbs keeps its directions.
void vary(Joint& joint, Link& link, bool turned, Random& random) {
  joint.origin.xyz = vector3(random.vector(3, 0.5));
  if (turned && random.chance(0.5)) joint.origin.rpy = vector3(random.vector(3, 3));
  if (turned && has_axis(joint.type) && random.chance(0.5))
    joint.axis = random.chance(0.5) ? -1.0 * joint.axis : vector3(random.direction(3));
  if (!link.inertial) return;
  const double scale = random.uniform(0.5, 2);
  Symmetric3<double>& I = link.inertial->inertia;
  I = {scale * I.xx, scale * I.yy, scale * I.zz, scale * I.xy, scale * I.xz, scale * I.yz};
  link.inertial->mass *= scale;
  link.inertial->origin.xyz = vector3(random.vector(3, 0.3));
}

/// Hangs a copy of `limb` on a link of `model` by a joint that turns.
void attach(Model& model, const Model& limb, int link, const std::string& name, Random& random) {
  const bool turned = random.chance(0.67);
  const int first_link = static_cast<int>(model.links.size());
  const int first_joint = static_cast<int>(model.joints.size()) + 1;
  Joint root;
  root.name = name + "root";
  root.type = JointType::kRevolute;
  root.parent = link;
  root.child = first_link + limb.root;
  root.axis = {0, 0, 1};
  std::vector<Joint> joints{root};
  for (Joint joint : limb.joints) {
    joint.name = name + joint.name;
    joint.parent += first_link;
    joint.child += first_link;
    if (joint.mimic) joint.mimic->leader += first_joint;
    joints.push_back(joint);
  }
  for (const Link& part : limb.links) {
    model.links.push_back(part);
    model.links.back().name = name + part.name;
  }
  for (Joint& joint : joints) {
    vary(joint, model.links[static_cast<size_t>(joint.child)], turned, random);
    model.joints.push_back(joint);
  }
}

}  // namespace

Model limb_model(std::uint64_t seed, const LimbModelOptions& options) {
  Random random(seed);
  RandomModelOptions trunk, limb;
  trunk.joints = random.integer(3);
  trunk.mimic = trunk.massless = false;
  limb.joints = random.integer(5);
  limb.massless = false;
  Model model = random_model(seed, trunk);
  const Model shape = random_model(seed + 5000, limb);
  const int link = random.integer(static_cast<int>(model.links.size()));
  for (int k = 0; k < options.limbs; ++k)
    attach(model, shape, link, "limb" + std::to_string(k) + "_", random);
  ModelOptions how;
  how.base = options.base;
  how.snap = 0;
  Diagnostics diagnostics;
  return configure(model, how, diagnostics);
}

}  // namespace arboc::test

#include "support/random_model.h"

#include <numeric>
#include <string>

#include "base/exact_trig.h"
#include "support/random.h"

namespace arboc::test {
namespace {

Vector3<double> vector3(const Eigen::VectorXd& a) { return {a[0], a[1], a[2]}; }

double random_angle(Random& random) {
  switch (random.integer(4)) {
    case 0: return 0;
    case 1: return degrees15(6 * (random.integer(5) - 2));
    case 2: return degrees15(random.integer(25) - 12);
    default: return random.uniform(-3.1, 3.1);
  }
}

Pose random_pose(Random& random) {
  Pose pose;
  for (int i = 0; i < 3; ++i) {
    if (random.chance(0.7)) pose.xyz[i] = random.uniform(-0.5, 0.5);
    pose.rpy[i] = random_angle(random);
  }
  return pose;
}

Vector3<double> random_axis(Random& random) {
  if (random.chance(0.4)) return vector3(random.direction(3));
  Vector3<double> axis;
  axis[random.integer(3)] = random.chance(0.5) ? 1 : -1;
  return axis;
}

/// A body that can exist: principal moments that obey the triangle inequality with room to spare,
/// turned arbitrarily.
Inertial random_inertial(Random& random) {
  Inertial result;
  result.origin = random_pose(random);
  result.mass = random.uniform(0.2, 5);
  const Eigen::Matrix3d R = Eigen::Matrix3d::NullaryExpr(
      [&](Eigen::Index, Eigen::Index) { return random.uniform(-0.2, 0.2); });
  const Eigen::Matrix3d second = result.mass * (R * R.transpose());
  const Eigen::Matrix3d I = (second.trace() + 0.01) * Eigen::Matrix3d::Identity() - second;
  result.inertia = {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)};
  return result;
}

JointType random_type(Random& random, const RandomModelOptions& options) {
  const double x = random.uniform(0, 1);
  if (x < 0.16) return JointType::kFixed;
  if (x < 0.22) return options.floating ? JointType::kFloating : JointType::kRevolute;
  if (x < 0.30) return options.planar ? JointType::kPlanar : JointType::kRevolute;
  if (x < 0.48) return options.prismatic ? JointType::kPrismatic : JointType::kContinuous;
  return x < 0.7 ? JointType::kContinuous : JointType::kRevolute;
}

/// Up to three axes, nearly or exactly those of the frame in some order: at angles within +-1 they
/// move the child in as many ways.
std::vector<JointAxis> random_axes(Random& random, bool universal) {
  std::vector<JointAxis> axes;
  const int first = random.integer(3), step = 1 + random.integer(2);
  const int count = universal ? 2 : 1 + random.integer(3);
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d axis = Eigen::Vector3d::Unit((first + i * step) % 3);
    if (random.chance(0.5)) axis = (-axis + 0.2 * random.direction(3)).normalized();
    axes.push_back({!universal && random.chance(0.4), vector3(axis)});
  }
  return axes;
}

/// What only some types have.
void complete(Joint& joint, Random& random) {
  if (joint.type == JointType::kHelical) joint.pitch = random.uniform(-0.3, 0.3);
  if (joint.type == JointType::kUniversal || joint.type == JointType::kMultiAxis)
    joint.axes = random_axes(random, joint.type == JointType::kUniversal);
}

void make_exotic(Joint& joint, Random& random) {
  constexpr JointType kTypes[] = {JointType::kUnbounded, JointType::kHelical, JointType::kSpherical,
                                  JointType::kUniversal, JointType::kMultiAxis};
  joint.type = kTypes[random.integer(5)];
  complete(joint, random);
}

Model random_tree(Random& random, const RandomModelOptions& options) {
  Model model;
  model.name = "random";
  model.root = 0;
  model.gravity = vector3(random.vector(3, 10));
  model.links.push_back({"link0", random_inertial(random), {}});
  const int joints =
      options.types.empty() ? options.joints : static_cast<int>(options.types.size());
  for (int k = 0; k < joints; ++k) {
    const std::string number = std::to_string(k + 1);
    Joint joint;
    joint.name = "joint" + number;
    joint.type = options.types.empty() ? random_type(random, options)
                                       : options.types[static_cast<size_t>(k)];
    // Long limbs with some branches.
    joint.parent = random.chance(0.7) ? k : random.integer(k + 1);
    joint.child = k + 1;
    joint.origin = random_pose(random);
    if (!options.types.empty()) complete(joint, random);
    if (options.exotic && random.chance(0.5)) make_exotic(joint, random);
    if (has_axis(joint.type)) joint.axis = random_axis(random);
    model.joints.push_back(joint);
    model.links.push_back({"link" + number, random_inertial(random), {}});
  }
  return model;
}

/// A link may lose its inertia if a revolute one moved by an inclined axis hangs on it: then no
/// motion of the two is without inertia.
void remove_inner_inertias(Model& model, Random& random) {
  const auto revolute = [](const Joint& joint) {
    return joint.type == JointType::kRevolute || joint.type == JointType::kContinuous;
  };
  for (size_t k = 1; k < model.joints.size(); ++k) {
    Joint& outer = model.joints[k];
    const int inner = outer.parent - 1;  // joint j moves link j + 1
    if (inner < 0 || !revolute(outer) || !revolute(model.joints[inner]) || !random.chance(0.3))
      continue;
    if (!model.links[outer.child].inertial) continue;
    outer.axis = vector3(random.direction(3));
    model.links[outer.parent].inertial.reset();
  }
  for (const Joint& joint : model.joints)
    if (joint.type == JointType::kFixed && joint.parent > 0 && model.links[joint.parent].inertial &&
        random.chance(0.3))
      model.links[joint.child].inertial.reset();
}

void remove_leaf_inertias(Model& model, Random& random) {
  std::vector<bool> leaf(model.links.size(), true);
  for (const Joint& joint : model.joints) leaf[joint.parent] = false;
  for (size_t i = 0; i < model.links.size(); ++i)
    if (leaf[i] && random.chance(0.5)) model.links[i].inertial.reset();
}

/// Each follower obeys a joint that comes before it in a random order, so no cycles arise.
void add_mimics(Model& model, Random& random) {
  std::vector<int> order;
  for (size_t k = 0; k < model.joints.size(); ++k)
    if (arboc::nq(model.joints[k]) == 1) order.push_back(static_cast<int>(k));
  for (size_t k = order.size(); k > 1; --k)
    std::swap(order[k - 1], order[random.integer(static_cast<int>(k))]);
  for (size_t k = 1; k < order.size(); ++k) {
    if (!random.chance(0.25)) continue;
    const int leader = order[random.integer(static_cast<int>(k))];
    model.joints[order[k]].mimic =
        Mimic{leader, random.chance(0.3) ? -1.0 : random.uniform(-2, 2), random.uniform(-1, 1)};
  }
}

}  // namespace

Model random_model(std::uint64_t seed, const RandomModelOptions& options) {
  Random random(seed);
  Model model = random_tree(random, options);
  if (options.massless) remove_inner_inertias(model, random);
  if (options.massless_leaves) remove_leaf_inertias(model, random);
  if (options.mimic) add_mimics(model, random);
  ModelOptions how;
  how.base = options.base;
  how.snap = 0;
  Diagnostics diagnostics;
  return configure(model, how, diagnostics);
}

}  // namespace arboc::test

#include "tree_models.h"

#include <stdexcept>
#include <string>

#include "base/exact_trig.h"

namespace arboc::test {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
  }
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  Vector3<double> vector(double size) {
    return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
  }

 private:
  std::mt19937 engine_;
};

Pose random_pose(Random& random, bool aligned) {
  if (!aligned) return {random.vector(1), random.vector(3)};
  Pose pose;
  for (int i = 0; i < 3; ++i) {
    pose.rpy[i] = degrees15(6 * (random.below(4) - 1));
    if (random.below(2) == 0) pose.xyz[i] = random.uniform(-1, 1);
  }
  return pose;
}

Inertial random_inertial(Random& random) {
  Inertial inertial;
  inertial.origin = random_pose(random, random.below(2) == 0);
  inertial.mass = random.uniform(0.5, 2);
  const double x = random.uniform(0.1, 1), y = random.uniform(0.1, 1), z = random.uniform(0.1, 1);
  inertial.inertia = {y + z, x + z, x + y, 0.05, -0.03, 0.02};
  return inertial;
}

Vector3<double> random_axis(Random& random, bool aligned) {
  Vector3<double> axis;
  if (aligned) {
    axis[random.below(3)] = random.below(2) == 0 ? 1 : -1;
    return axis;
  }
  axis = random.vector(1);
  return (1 / std::sqrt(dot(axis, axis))) * axis;
}

JointType random_type(Random& random, const RandomModelOptions& options) {
  switch (random.below(options.many_freedoms ? 12 : 10)) {
    case 0:
    case 1: return JointType::kFixed;
    case 2:
    case 3: return JointType::kPrismatic;
    case 4: return JointType::kContinuous;
    case 10: return JointType::kPlanar;
    case 11: return JointType::kFloating;
    default: return JointType::kRevolute;
  }
}

/// Followers may stand before their leader, and lead others.
void add_mimics(Random& random, Model& model) {
  std::vector<int> single;
  for (size_t k = 0; k < model.joints.size(); ++k)
    if (nv(model.joints[k].type) == 1) single.push_back(static_cast<int>(k));
  for (size_t k = 0; k + 1 < single.size(); k += 3) {
    const size_t other =
        k + 1 + static_cast<size_t>(random.below(static_cast<int>(single.size() - k - 1)));
    Joint& follower = model.joints[static_cast<size_t>(single[k])];
    follower.mimic = {single[other], random.uniform(-2, 2), random.uniform(-1, 1)};
  }
}

Eigen::Vector3d eigen(const Vector3<double>& a) { return {a.x, a.y, a.z}; }
Eigen::Matrix3d eigen(const Matrix3<double>& A) {
  Eigen::Matrix3d B;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) B(i, j) = A(i, j);
  return B;
}
Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d S;
  S << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return S;
}

/// Child in parent.
Eigen::Isometry3d placement(const Joint& joint, const Coordinates::Entry& entry, const State& s) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity(), J = T;
  T.linear() = eigen(rotation(joint.origin));
  T.translation() = eigen(joint.origin.xyz);
  const double* q = s.q.data() + entry.q;
  const Eigen::Vector3d axis = eigen(joint.axis);
  switch (joint.type) {
    case JointType::kFixed: break;
    case JointType::kRevolute:
    case JointType::kContinuous:
      J.linear() = Eigen::AngleAxisd(entry.multiplier * *q + entry.offset, axis).toRotationMatrix();
      break;
    case JointType::kPrismatic:
      J.translation() = (entry.multiplier * *q + entry.offset) * axis;
      break;
    case JointType::kPlanar:
      J.translation() = eigen(axis_frame(joint.axis)) * Eigen::Vector3d(q[0], q[1], 0);
      J.linear() = Eigen::AngleAxisd(q[2], axis).toRotationMatrix();
      break;
    case JointType::kFloating:
      J.translation() = Eigen::Vector3d(q[0], q[1], q[2]);
      J.linear() = Eigen::Quaterniond(q[6], q[3], q[4], q[5]).toRotationMatrix();
      break;
    default: throw std::logic_error("not among the random types");
  }
  return T * J;
}

/// Motion subspace in the child's frame, angular first.
Eigen::MatrixXd subspace(const Joint& joint) {
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(6, nv(joint.type));
  const Eigen::Matrix3d Q = eigen(axis_frame(joint.axis));
  switch (joint.type) {
    case JointType::kFixed: break;
    case JointType::kRevolute:
    case JointType::kContinuous: S.topRows(3) = eigen(joint.axis); break;
    case JointType::kPrismatic: S.bottomRows(3) = eigen(joint.axis); break;
    case JointType::kPlanar:
      S.bottomRows(3).leftCols(2) = Q.leftCols(2);
      S.topRows(3).col(2) = Q.col(2);
      break;
    case JointType::kFloating:
      S.bottomRows(3).leftCols(3).setIdentity();
      S.topRows(3).rightCols(3).setIdentity();
      break;
    default: throw std::logic_error("not among the random types");
  }
  return S;
}

Matrix6 spatial_inertia(const Inertial& inertial) {
  const Symmetric3<double>& I = inertial.inertia;
  const Eigen::Matrix3d R = eigen(rotation(inertial.origin));
  const Eigen::Matrix3d c = skew(eigen(inertial.origin.xyz));
  Matrix6 result;
  result << R * eigen(full(I)) * R.transpose() - inertial.mass * c * c, inertial.mass * c,
      -inertial.mass * c, inertial.mass * Eigen::Matrix3d::Identity();
  return result;
}

/// Motion vectors from the parent's to the child's frame.
Matrix6 transform(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d E = T.linear().transpose();
  Matrix6 X;
  X << E, Eigen::Matrix3d::Zero(), -E * skew(T.translation()), E;
  return X;
}

Matrix6 motion_cross(const Vector6& v) {
  Matrix6 X;
  X << skew(v.head<3>()), Eigen::Matrix3d::Zero(), skew(v.tail<3>()), skew(v.head<3>());
  return X;
}

}  // namespace

Model random_model(unsigned seed, const RandomModelOptions& options) {
  Random random(seed);
  Model model;
  model.name = "random" + std::to_string(seed);
  model.root = 0;
  model.gravity = {0.4, -0.3, -9.81};
  for (int k = 0; k <= options.joints; ++k) {
    Link link;
    link.name = "link" + std::to_string(k);
    if (options.every_link_has_mass || random.below(5) > 0) link.inertial = random_inertial(random);
    model.links.push_back(link);
    if (k == 0) continue;
    Joint joint;
    joint.name = "joint" + std::to_string(k);
    joint.type = random_type(random, options);
    joint.parent = random.below(3) == 0 ? random.below(k) : k - 1;
    joint.child = k;
    joint.origin = random_pose(random, options.aligned);
    joint.axis = random_axis(random, options.aligned);
    model.joints.push_back(joint);
  }
  if (options.mimic) add_mimics(random, model);
  ModelOptions how;
  how.base = options.base;
  how.snap = 0;
  Diagnostics diagnostics;
  return configure(model, how, diagnostics);
}

State random_state(const Model& model, unsigned seed) {
  Random random(seed);
  const Coordinates where = coordinates(model);
  State state;
  for (int i = 0; i < where.nq; ++i) state.q.push_back(random.uniform(-2, 2));
  for (int i = 0; i < where.nv; ++i) state.v.push_back(random.uniform(-2, 2));
  for (int i = 0; i < where.nv; ++i) state.a.push_back(random.uniform(-2, 2));
  for (size_t k = 0; k < model.joints.size(); ++k) {
    if (model.joints[k].type != JointType::kFloating) continue;
    Eigen::Map<Eigen::Vector4d> quaternion(state.q.data() + where.joint[k].q + 3);
    quaternion.normalize();
  }
  return state;
}

Eigen::VectorXd spatial_rnea(const Model& model, const State& state) {
  const Coordinates where = coordinates(model);
  const size_t n = model.links.size();
  std::vector<Vector6> v(n, Vector6::Zero()), a(n, Vector6::Zero()), f(n, Vector6::Zero());
  std::vector<Matrix6> X(model.joints.size());
  Vector6 base = Vector6::Zero();
  base.tail<3>() = -eigen(model.gravity);
  a[static_cast<size_t>(model.root)] = base;
  const auto entries = [&](const std::vector<double>& x, size_t k) -> Eigen::VectorXd {
    const Coordinates::Entry& entry = where.joint[k];
    const int size = nv(model.joints[k].type);
    if (size == 0) return Eigen::VectorXd(0);
    return entry.multiplier * Eigen::Map<const Eigen::VectorXd>(x.data() + entry.v, size);
  };
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    const auto child = static_cast<size_t>(joint.child);
    const Vector6 v_parent =
        joint.parent < 0 ? Vector6::Zero().eval() : v[static_cast<size_t>(joint.parent)];
    const Vector6 a_parent = joint.parent < 0 ? base : a[static_cast<size_t>(joint.parent)];
    X[k] = transform(placement(joint, where.joint[k], state));
    const Eigen::MatrixXd S = subspace(joint);
    const Vector6 v_joint = S * entries(state.v, k);
    v[child] = X[k] * v_parent + v_joint;
    a[child] = X[k] * a_parent + S * entries(state.a, k) + motion_cross(v[child]) * v_joint;
    if (!model.links[child].inertial) continue;
    const Matrix6 I = spatial_inertia(*model.links[child].inertial);
    f[child] = I * a[child] - motion_cross(v[child]).transpose() * I * v[child];
  }
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(where.nv);
  for (size_t k = model.joints.size(); k-- > 0;) {
    const Joint& joint = model.joints[k];
    const auto child = static_cast<size_t>(joint.child);
    if (nv(joint.type) > 0)
      tau.segment(where.joint[k].v, nv(joint.type)) +=
          where.joint[k].multiplier * subspace(joint).transpose() * f[child];
    if (joint.parent >= 0) f[static_cast<size_t>(joint.parent)] += X[k].transpose() * f[child];
  }
  return tau;
}

Eigen::MatrixXd spatial_inertia(Model model, const State& state) {
  model.gravity = {0, 0, 0};
  const auto nv = static_cast<Eigen::Index>(state.v.size());
  Eigen::MatrixXd M(nv, nv);
  State unit{state.q, std::vector<double>(state.v.size(), 0), {}};
  for (Eigen::Index j = 0; j < nv; ++j) {
    unit.a.assign(state.v.size(), 0);
    unit.a[static_cast<size_t>(j)] = 1;
    M.col(j) = spatial_rnea(model, unit);
  }
  return M;
}

std::vector<Eigen::Isometry3d> placements(const Model& model, const State& state) {
  const Coordinates where = coordinates(model);
  std::vector<Eigen::Isometry3d> T(model.links.size(), Eigen::Isometry3d::Identity());
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    const Eigen::Isometry3d parent =
        joint.parent < 0 ? Eigen::Isometry3d::Identity() : T[static_cast<size_t>(joint.parent)];
    T[static_cast<size_t>(joint.child)] = parent * placement(joint, where.joint[k], state);
  }
  return T;
}

}  // namespace arboc::test

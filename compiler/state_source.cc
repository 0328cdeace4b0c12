#include "state_source.h"

#include <algorithm>

namespace arboc {
namespace {

std::vector<double> list(const Eigen::VectorXd& x) { return {x.data(), x.data() + x.size()}; }

}  // namespace

double StateSource::uniform(double low, double high) {
  // splitmix64
  std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  z ^= z >> 31;
  return low + (high - low) * static_cast<double>(z >> 11) * 0x1p-53;
}

State StateSource::next(const Model& model) {
  const Coordinates at = coordinates(model);
  State s{Eigen::VectorXd(at.nq), Eigen::VectorXd(at.nv), Eigen::VectorXd(at.nv),
          Eigen::VectorXd(at.nv)};
  for (size_t k = 0; k < model.joints.size(); ++k) {
    const Joint& joint = model.joints[k];
    const int q = at.joint[k].q;
    if (nv(joint.type) == 0 || joint.mimic) continue;
    if (nq(joint.type) == 1) {
      const double range = joint.type == JointType::kPrismatic ? 1 : 3.14;
      s.q[q] = uniform(std::max(-range, joint.limits.lower), std::min(range, joint.limits.upper));
      continue;
    }
    for (int i = 0; i < nq(joint.type); ++i) s.q[q + i] = uniform(-1, 1);
    if (joint.type == JointType::kPlanar) s.q[q + 2] *= 3.14;
    if (joint.type == JointType::kUnbounded) s.q.segment(q, 2).normalize();
    const int quaternion = quaternion_at(joint.type);
    if (quaternion >= 0) s.q.segment(q + quaternion, 4).normalize();
  }
  for (int i = 0; i < at.nv; ++i) {
    s.v[i] = uniform(-2, 2);
    s.a[i] = uniform(-5, 5);
    s.tau[i] = uniform(-10, 10);
  }
  return s;
}

std::vector<double> StateSource::vector(int size, double bound) {
  std::vector<double> values;
  for (int k = 0; k < size; ++k) values.push_back(uniform(-bound, bound));
  return values;
}

std::vector<double> StateSource::parameter(const Parameter& parameter) {
  std::vector<double> values = parameter.nominal;
  const auto n = static_cast<size_t>(parameter.size());
  const bool length =
      parameter.kind == Parameter::Kind::kLength || parameter.kind == Parameter::Kind::kCentre;
  for (size_t first = 0; first < values.size(); first += n) {
    const double factor = uniform(0.8, 1.2);
    for (size_t k = first; k < first + n; ++k) {
      values[k] *= factor;
      if (length) values[k] += uniform(-0.05, 0.05);
    }
  }
  return values;
}

Values StateSource::inputs(const Setup& setup) {
  const State state = next(setup.model);
  Values values{
      {"q", list(state.q)}, {"v", list(state.v)}, {"a", list(state.a)}, {"tau", list(state.tau)}};
  values["q1"] = list(next(setup.model).q);
  values["f_ext"] = vector(static_cast<int>(6 * setup.loads.size()), 10);
  for (const Parameter& p : setup.parameters) values[p.name] = parameter(p);
  return values;
}

}  // namespace arboc

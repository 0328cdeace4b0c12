#include "record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/number.h"

namespace arboc {
namespace {

std::vector<double> values(const Eigen::VectorXd& x) { return {x.data(), x.data() + x.size()}; }

std::vector<double> by_rows(const Eigen::MatrixXd& m) {
  const Eigen::MatrixXd t = m.transpose();
  return {t.data(), t.data() + t.size()};
}

Eigen::VectorXd vector(const Values& inputs, const char* name) {
  const auto& x = inputs.at(name);
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// Twelve digits: what differs between machines in the last bits must not reach generated files.
std::vector<double> rounded(std::vector<double> values) {
  for (double& x : values) x = parse_finite(fmt::format("{:.12g}", x)).value_or(x) + 0.0;
  return values;
}

/// Results known to `tolerance` of the largest entry to a tenth of that: differences leave noise
/// also where there is nothing.
std::vector<double> rounded(std::vector<double> values, double tolerance) {
  if (tolerance <= Argument().tolerance) return rounded(std::move(values));
  double largest = 0;
  for (const double x : values) largest = std::max(largest, std::fabs(x));
  int decimals = 0;
  for (double unit = 10; unit > tolerance * largest && decimals < 30; unit /= 10) ++decimals;
  for (double& x : values) x = parse_finite(fmt::format("{:.{}f}", x, decimals)).value_or(x) + 0.0;
  return rounded(std::move(values));
}

std::vector<double> placements(const Model& model, const Reference& reference,
                               const Eigen::VectorXd& q) {
  std::vector<double> out;
  const auto links = reference.fk(q);
  for (const Joint& joint : model.joints) {
    if (nv(joint.type) == 0) continue;
    const Placement& T = links[static_cast<size_t>(joint.child)];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) out.push_back(T.R(r, c));
    for (int r = 0; r < 3; ++r) out.push_back(T.p(r));
  }
  return out;
}

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
    if (nv(joint.type) == 1) {
      const double range = joint.type == JointType::kPrismatic ? 1 : 3.14;
      s.q[q] = uniform(std::max(-range, joint.limits.lower), std::min(range, joint.limits.upper));
      continue;
    }
    for (int i = 0; i < nq(joint.type); ++i) s.q[q + i] = uniform(-1, 1);
    if (joint.type == JointType::kPlanar) s.q[q + 2] *= 3.14;
    if (joint.type == JointType::kFloating) s.q.segment(q + 3, 4).normalize();
  }
  for (int i = 0; i < at.nv; ++i) {
    s.v[i] = uniform(-2, 2);
    s.a[i] = uniform(-5, 5);
    s.tau[i] = uniform(-10, 10);
  }
  return s;
}

Values evaluate_reference(const std::string& function, const Model& model,
                          const Reference& reference, const Values& inputs) {
  const Eigen::VectorXd q = vector(inputs, "q");
  if (function == "fk") return {{"placements", placements(model, reference, q)}};
  if (function == "rnea")
    return {{"tau", values(reference.rnea(q, vector(inputs, "v"), vector(inputs, "a")))}};
  if (function == "gravity") return {{"g", values(reference.gravity(q))}};
  if (function == "nle") return {{"nle", values(reference.nle(q, vector(inputs, "v")))}};
  if (function == "crba") return {{"M", by_rows(reference.crba(q))}};
  if (function == "minv") return {{"Minv", by_rows(reference.minv(q))}};
  if (function == "rnea_derivatives") {
    const ComplexReference complex(model);
    const auto rnea = [](const auto& r, const auto& x) { return r.rnea(x.q, x.v, x.a); };
    const State at{q, vector(inputs, "v"), vector(inputs, "a"), {}};
    return {{"dtau_dq", by_rows(differentiate(complex, rnea, at, With::kQ))},
            {"dtau_dv", by_rows(differentiate(complex, rnea, at, With::kV))},
            {"M", by_rows(reference.crba(q))}};
  }
  return {{"qdd", values(reference.aba(q, vector(inputs, "v"), vector(inputs, "tau")))}};
}

void record(const Model& model, TargetModel& target) {
  // The dense matrices of more states would make the file of a humanoid larger than its code.
  const int states = target.nv > 20 ? 2 : 4;
  const Reference reference(model);
  StateSource source(1);
  for (int s = 0; s < states; ++s) {
    State state = source.next(model);
    Recording recording;
    Values& v = recording.values;
    v["q"] = values(state.q);
    v["v"] = values(state.v);
    v["a"] = values(state.a);
    v["tau"] = values(state.tau);
    const Eigen::VectorXd curve = 0.5 * target.step * target.step * state.a;
    v["q-"] = rounded(values(reference.integrate(state.q, -target.step * state.v + curve)));
    v["q+"] = rounded(values(reference.integrate(state.q, target.step * state.v + curve)));
    const Values inputs = v;
    for (const TargetFunction& f : target.functions) {
      Values results = evaluate_reference(f.signature.name, model, reference, inputs);
      for (const Argument& a : f.signature.outputs)
        v[f.signature.name + "." + a.name] = rounded(std::move(results[a.name]), a.tolerance);
    }
    target.recordings.push_back(std::move(recording));
  }
}

}  // namespace arboc

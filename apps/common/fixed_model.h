// Bodies whose first link is held, of joints of one coordinate each, with functions of their
// generated code on vectors whose sizes are not known when programs are compiled.
//
//   arboc_add_model(arm MODEL arm.dh.toml FUNCTIONS fk rnea energy)
//   arboc_add_model(arm_rates MODEL arm.dh.toml FUNCTIONS frame_velocity joint_jacobians
//                   OPTIONS --axes aligned --frames LINKS)   # that joints move, in their order
//   const study::FixedModel m = STUDY_FIXED_MODEL(arm, arm_rates);
#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace study {

struct FixedModel {
  using Vector = Eigen::VectorXd;

  std::string name;
  std::vector<std::string> joints;
  Vector q_lower, q_upper, tau_lower, tau_upper;
  std::vector<std::string> frames;
  std::function<void(const Vector& q, const Vector& v, const Vector& a, Vector& tau)> rnea;
  std::function<double(const Vector& q, const Vector& v)> kinetic_energy;  ///< J
  std::function<void(const Vector& q, double* placements)> fk;             ///< 12 a frame
  /// Angular velocity of the segment that each joint moves, along the joint's axis, rad/s.
  std::function<void(const Vector& q, const Vector& v, Vector& rates)> segment_rates;

  int size() const { return static_cast<int>(joints.size()); }
  int joint(const std::string& wanted) const;  ///< throws std::invalid_argument
  int frame(const std::string& wanted) const;
};

#define STUDY_FIXED_MODEL(ns, rates_ns)                                                       \
  [] {                                                                                        \
    using Vector = Eigen::VectorXd;                                                           \
    static_assert(ns::nq == ns::nv, "joints of one coordinate each");                         \
    static_assert(rates_ns::frame::count == ns::nv, "a link a joint");                        \
    const auto list = [](const double* x) -> Vector {                                         \
      return Eigen::Map<const Vector>(x, ns::nv);                                             \
    };                                                                                        \
    study::FixedModel fixed;                                                                  \
    fixed.name = #ns;                                                                         \
    fixed.joints.assign(ns::velocity_names, ns::velocity_names + ns::nv);                     \
    fixed.q_lower = list(ns::q_lower), fixed.q_upper = list(ns::q_upper);                     \
    fixed.tau_lower = list(ns::tau_lower), fixed.tau_upper = list(ns::tau_upper);             \
    fixed.frames.assign(ns::frame::names, ns::frame::names + ns::frame::count);               \
    fixed.rnea = [](const Vector& q, const Vector& v, const Vector& a, Vector& tau) {         \
      tau.resize(ns::nv);                                                                     \
      ns::raw::rnea<double>(q.data(), v.data(), a.data(), tau.data());                        \
    };                                                                                        \
    fixed.kinetic_energy = [](const Vector& q, const Vector& v) {                             \
      double T[1], V[1];                                                                      \
      ns::raw::energy<double>(q.data(), v.data(), T, V);                                      \
      return T[0];                                                                            \
    };                                                                                        \
    fixed.fk = [](const Vector& q, double* placements) {                                      \
      ns::raw::fk<double>(q.data(), placements);                                              \
    };                                                                                        \
    fixed.segment_rates = [](const Vector& q, const Vector& v, Vector& rates) {               \
      double velocity[6 * ns::nv];                                                            \
      double axes[6 * ns::nv], dense[6 * ns::nv] = {};                                        \
      rates_ns::raw::frame_velocity<double>(q.data(), v.data(), velocity);                    \
      rates_ns::raw::joint_jacobians<double>(q.data(), axes);                                 \
      rates_ns::raw::scatter_joint_jacobians_J_world(axes, dense, 1, 6);                      \
      rates.resize(ns::nv);                                                                   \
      for (int j = 0; j < ns::nv; ++j)                                                        \
        rates[j] = Eigen::Map<const Eigen::Vector3d>(dense + 6 * j + 3)                       \
                       .dot(Eigen::Map<const Eigen::Vector3d>(velocity + 6 * j + 3));         \
    };                                                                                        \
    return fixed;                                                                             \
  }()

}  // namespace study

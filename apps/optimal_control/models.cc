#include "models.h"

#include <arboc/nlp/generated.hpp>
#include <lifter/lifter.hpp>
#include <lifter/lifter_batch.hpp>
#include <lifter_rates/lifter_rates.hpp>
#include <rotor/rotor.hpp>
#include <rotor/rotor_batch.hpp>
#include <rotor_rates/rotor_rates.hpp>
#include <stdexcept>

#include "ladder/body.h"

namespace optimal_control {
namespace {

#define OPTIMAL_CONTROL_MODEL(ns)                                                                 \
  [] {                                                                                            \
    namespace nlp = arboc::nlp;                                                                   \
    Model with{STUDY_FIXED_MODEL(ns, ns##_rates), nullptr, nullptr, {}};                          \
    with.torques = std::make_shared<nlp::Generated<ns::rnea_fn, ns::rnea_tau_jacobian_q_v_a_fn,   \
                                                   ns::rnea_tau_hessian_q_v_a_fn>>();             \
    with.placements = std::make_shared<nlp::Generated<ns::fk_fn, ns::fk_placements_jacobian_q_fn, \
                                                      ns::fk_placements_hessian_q_fn>>();         \
    return with;                                                                                  \
  }()

Model lifter_model() {
  Model m = OPTIMAL_CONTROL_MODEL(lifter);
  m.limbs = {{"shanks", "thighs", "trunk", "upper_arms", "forearms", "weight"},
             {"upper_arms", "head"}};
  return m;
}

Model rotor_model() {
  Model m = OPTIMAL_CONTROL_MODEL(rotor);
  m.limbs = {{"disc", "rim"}};
  return m;
}

/// Held at one hand; drawn from there.
Model ladder_model(ladder::Hand held) {
  const ladder::Tree& t = ladder::tree(held);
  Model m{t, t.torques, nullptr, {}};
  const auto& f = t.frames;
  m.limbs = {{f[ladder::kRightHand], f[ladder::kRightElbow], f[ladder::kRightShoulder],
              f[ladder::kLeftShoulder], f[ladder::kLeftElbow], f[ladder::kLeftHand]},
             {f[ladder::kRightShoulder], f[ladder::kThighs], f[ladder::kShanks], f[ladder::kFeet]},
             {f[ladder::kLeftShoulder], f[ladder::kThighs]}};
  return m;
}

}  // namespace

const Model& model(const std::string& name) {
  static const std::vector<Model> models = {
      lifter_model(), rotor_model(), ladder_model(ladder::kRight), ladder_model(ladder::kLeft)};
  std::string known;
  for (const Model& m : models) {
    if (m.name == name) return m;
    known += (known.empty() ? "" : ", ") + m.name;
  }
  throw std::invalid_argument("there is no model '" + name + "'; those in this program are " +
                              known);
}

}  // namespace optimal_control

#include "models.h"

#include <algorithm>
#include <human_afloat/human_afloat.hpp>
#include <human_rates/human_rates.hpp>
#include <stdexcept>
#include <turn/turn.hpp>
#include <turn_rates/turn_rates.hpp>

namespace self_orientation {
namespace {

/// Functions of a generated namespace on vectors whose sizes are not known when this is compiled.
/// Gravity is nought: `rest` are the inputs behind q, v and a.
#define SELF_ORIENTATION_MODEL(ns, rates, ...)                                              \
  [] {                                                                                      \
    Model made;                                                                             \
    made.nq = ns::nq;                                                                       \
    made.nv = ns::nv;                                                                       \
    made.joints.assign(ns::velocity_names + 6, ns::velocity_names + ns::nv);                \
    made.q_lower = Eigen::Map<const Vector>(ns::q_lower + 7, ns::nq - 7);                   \
    made.q_upper = Eigen::Map<const Vector>(ns::q_upper + 7, ns::nq - 7);                   \
    made.start = Vector::Zero(ns::nv - 6);                                                  \
    made.frames.assign(ns::frame::names, ns::frame::names + ns::frame::count);              \
    made.momentum = [](const Vector& q, const Vector& v, const Vector& a) {                 \
      Eigen::Matrix<double, 6, ns::nv> A_G;                                                 \
      Momentum out;                                                                         \
      ns::Centroidal wanted;                                                                \
      wanted.h = &out.h;                                                                    \
      wanted.A_G = &A_G;                                                                    \
      wanted.dh = &out.dh;                                                                  \
      ns::centroidal(q, v, a __VA_ARGS__, wanted);                                          \
      out.A_G = A_G;                                                                        \
      return out;                                                                           \
    };                                                                                      \
    made.rnea = [](const Vector& q, const Vector& v, const Vector& a) -> Vector {           \
      return ns::rnea(q, v, a __VA_ARGS__);                                                 \
    };                                                                                      \
    made.crba = [](const Vector& q) -> Matrix { return ns::crba(q __VA_ARGS__); };          \
    made.com = [](const Vector& q) -> Eigen::Vector3d {                                     \
      Eigen::Vector3d c;                                                                    \
      ns::Com wanted;                                                                       \
      wanted.c = &c;                                                                        \
      ns::com(q, ns::Tangent::Zero() __VA_ARGS__, wanted);                                  \
      return c;                                                                             \
    };                                                                                      \
    made.energy = [](const Vector& q, const Vector& v) {                                    \
      Energy out;                                                                           \
      ns::Energy wanted;                                                                    \
      wanted.T_ = &out.T;                                                                   \
      ns::energy(q, v __VA_ARGS__, wanted);                                                 \
      ns::Tangent by_q, by_v;                                                               \
      ns::EnergyTGradientQV gradient;                                                       \
      gradient.grad_q = &by_q;                                                              \
      gradient.grad_v = &by_v;                                                              \
      ns::energy_T_gradient_q_v(q, v __VA_ARGS__, gradient);                                \
      out.by_q = by_q;                                                                      \
      out.by_v = by_v;                                                                      \
      return out;                                                                           \
    };                                                                                      \
    made.integrate = [](const Vector& q, const Vector& v) -> Vector {                       \
      return ns::integrate(q, v __VA_ARGS__);                                               \
    };                                                                                      \
    made.fk = [](const Vector& q) {                                                         \
      const auto placements = ns::fk(q __VA_ARGS__);                                        \
      return std::vector<double>(placements.data(), placements.data() + placements.size()); \
    };                                                                                      \
    static_assert(rates::frame::count == ns::nv - 5, "a link a joint, and the base");           \
    made.segment_rates = [](const Vector& q, const Vector& v) {                             \
      /* Frame k is of the link that joint k moves; the base is the first. */               \
      const auto velocity = rates::frame_velocity(q, v);                                    \
      const auto axes = rates::joint_jacobians(q);                                          \
      Vector out(ns::nv - 6);                                                               \
      for (int j = 0; j < ns::nv - 6; ++j)                                                  \
        out[j] = velocity.row(j + 1).tail<3>().dot(axes.col(j + 6).tail<3>().transpose());  \
      return out;                                                                           \
    };                                                                                      \
    return made;                                                                            \
  }()

Model turn_model() {
  Model m = SELF_ORIENTATION_MODEL(turn, turn_rates);
  m.limbs = {{"torso", "r_leg.private", "r_foot"}, {"torso", "l_leg.private", "l_foot"}};
  m.paper = true;
  return m;
}

Model human_model() {
#define NO_GRAVITY , Eigen::Vector3d::Zero()
  Model m = SELF_ORIENTATION_MODEL(human_afloat, human_rates, NO_GRAVITY);
  for (int i = 0; i < m.nv - 6; ++i) m.start[i] = human_afloat::q_relaxed[i + 7];
  m.limbs = {{"base", "z3", "z6", "z9", "z12", "z14", "z17", "z19", "z21"},
             {"z9", "z22", "z24", "z27", "z29", "z31"},
             {"z9", "z32", "z35", "z37"},
             {"base", "z38", "z41", "z42", "z45"},
             {"base", "z46", "z49", "z50", "z53"}};
  return m;
}

}  // namespace

int Model::joint(const std::string& wanted) const {
  const auto at = std::find(joints.begin(), joints.end(), wanted);
  if (at != joints.end()) return static_cast<int>(at - joints.begin());
  std::string known;
  for (const std::string& n : joints) known += (known.empty() ? "" : ", ") + n;
  throw std::invalid_argument(name + " has no joint '" + wanted + "'; its joints are " + known);
}

Vector Model::at_origin(const Vector& joint_angles) const {
  Vector q(nq);
  q << 0, 0, 0, 0, 0, 0, 1, joint_angles;
  return q;
}

const Model& model(const std::string& name) {
  static const std::vector<Model> models = [] {
    std::vector<Model> all = {turn_model(), human_model()};
    all[0].name = "astronaut_turn";
    all[1].name = "santos";
    return all;
  }();
  for (const Model& m : models)
    if (m.name == name) return m;
  throw std::invalid_argument("there is no model '" + name +
                              "'; those in this program are astronaut_turn, santos");
}

}  // namespace self_orientation

#include "body.h"

#include <arboc/nlp/generated.hpp>
#include <ladder_left/ladder_left.hpp>
#include <ladder_left/ladder_left_batch.hpp>
#include <ladder_left_rates/ladder_left_rates.hpp>
#include <ladder_right/ladder_right.hpp>
#include <ladder_right/ladder_right_batch.hpp>
#include <ladder_right_rates/ladder_right_rates.hpp>

namespace ladder {
namespace {

#define LADDER_TREE(ns, hand)                                                                \
  [] {                                                                                       \
    static_assert(ns::nv == kJoints && ns::frame::count == kFrames, "of other size");        \
    Tree made{STUDY_FIXED_MODEL(ns, ns##_rates), hand, {}, {}, {}, {}, {}, {}};              \
    made.jacobian = [](const Joints& q, double* J) {                                         \
      Eigen::Map<Eigen::Matrix<double, 6 * kFrames, kJoints>>{J} = ns::frame_jacobian(q);    \
    };                                                                                       \
    made.acceleration = [](const Joints& q, const Joints& v, const Joints& a, double* out) { \
      ns::raw::frame_acceleration<double>(q.data(), v.data(), a.data(), out);                \
    };                                                                                       \
    made.momentum_rate = [](const Joints& q, const Joints& v, const Joints& a, double* dh) { \
      double h[6], A_G[6 * kJoints];                                                         \
      ns::raw::centroidal<double>(q.data(), v.data(), a.data(), h, A_G, dh);                 \
    };                                                                                       \
    made.mass_matrix = [](const Joints& q) -> Matrix { return ns::crba(q); };                \
    made.torques =                                                                           \
        std::make_shared<arboc::nlp::Generated<ns::rnea_fn, ns::rnea_tau_jacobian_q_v_a_fn,  \
                                               ns::rnea_tau_hessian_q_v_a_fn>>();            \
    return made;                                                                             \
  }()

std::array<Tree, 2> both_trees() {
  std::array<Tree, 2> trees = {LADDER_TREE(ladder_right, kRight), LADDER_TREE(ladder_left, kLeft)};
  for (Tree& t : trees)
    for (int j = 0; j < kJoints; ++j)
      t.index[static_cast<std::size_t>(j)] = t.joint(trees[0].joints[static_cast<std::size_t>(j)]);
  return trees;
}

}  // namespace

Joints Tree::own(const Joints& canonical) const {
  Joints out;
  for (int j = 0; j < kJoints; ++j) out[index[static_cast<std::size_t>(j)]] = canonical[j];
  return out;
}
Joints Tree::canonical(const Joints& own) const {
  Joints out;
  for (int j = 0; j < kJoints; ++j) out[j] = own[index[static_cast<std::size_t>(j)]];
  return out;
}

const Tree& tree(Hand held) {
  static const std::array<Tree, 2> trees = both_trees();
  return trees[held];
}

const Lengths& lengths() {
  static const Lengths all = [] {
    double at[12 * kFrames];
    tree(kRight).fk(Vector::Zero(kJoints), at);
    const auto p = [&](Frame f) { return Vector3(at + 12 * f + 9); };
    return Lengths{(p(kRightElbow) - p(kRightHand)).norm(),
                   (p(kRightShoulder) - p(kRightElbow)).norm(),
                   (p(kLeftShoulder) - p(kRightShoulder)).norm()};
  }();
  return all;
}

const std::vector<std::string>& joints() { return tree(kRight).joints; }
int joint(const std::string& name) { return tree(kRight).joint(name); }

}  // namespace ladder

// The astronaut of [Astronaut] section 5, held at one hand or the other: generated code of two
// trees over the same thirteen joints.  Coordinates are in the order of the tree at the right hand.
#pragma once
#include <array>
#include <memory>

#include <arboc/nlp/function.hpp>

#include "common/fixed_model.h"
#include "task.h"

namespace ladder {

using Vector = Eigen::VectorXd;
using Vector3 = Eigen::Vector3d;
using Matrix = Eigen::MatrixXd;

constexpr int kJoints = 13;
constexpr int kArms = 10;  ///< the joints between the hands, first
using Joints = Eigen::Matrix<double, kJoints, 1>;

/// Frames that both trees report, in this order.
enum Frame {
  kRightHand,
  kRightElbow,
  kRightShoulder,
  kTorso,
  kLeftShoulder,
  kLeftElbow,
  kLeftHand,
  kThighs,
  kShanks,
  kTorsoCentre,
  kFeet,
  kFrames
};

/// One tree; positions are from the hand that holds.
struct Tree : study::FixedModel {
  Hand held = kRight;
  std::array<int, kJoints> index{};  ///< of each joint of the right tree in this one
  std::function<void(const Joints& q, double* J)> jacobian;  ///< 6 kFrames x 13, by columns
  std::function<void(const Joints& q, const Joints& v, const Joints& a, double* out)>
      acceleration;  ///< 6 a frame: of the origin and angular, along world axes
  std::function<void(const Joints& q, const Joints& v, const Joints& a, double* dh)>
      momentum_rate;                                   ///< N, N m about the centre of mass
  std::function<Matrix(const Joints& q)> mass_matrix;  ///< in this tree's order
  std::shared_ptr<arboc::nlp::Function> torques;       ///< q, v, a -> tau, this tree's order

  Joints own(const Joints& canonical) const;  ///< in this tree's order
  Joints canonical(const Joints& own) const;
};

const Tree& tree(Hand held);

/// Lengths of the model, from its placements at zero.
struct Lengths {
  double forearm, upper_arm, shoulders;
};
const Lengths& lengths();

/// Joint names, limits: in the common order.
const std::vector<std::string>& joints();
int joint(const std::string& name);

}  // namespace ladder

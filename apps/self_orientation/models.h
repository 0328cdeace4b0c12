// Bodies afloat whose generated code the program contains: a base with six freedoms, then joints of
// one coordinate each.
#pragma once
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace self_orientation {

using Vector = Eigen::VectorXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix = Eigen::MatrixXd;

/// Momentum and its rate about the centre of mass, along world axes: force, then moment.
struct Momentum {
  Vector6 h;   ///< kg m/s, kg m^2/s
  Matrix A_G;  ///< 6 x nv, h = A_G v
  Vector6 dh;  ///< N, N m
};

struct Energy {
  double T = 0;           ///< J
  Vector by_q{}, by_v{};  ///< its derivatives along the motions of the body
};

/// q: position and quaternion of the base, then joints; v: velocities of the base along its axes.
struct Model {
  std::string name;
  int nq = 0, nv = 0;
  std::vector<std::string> joints;  ///< nv - 6
  Vector q_lower, q_upper;          ///< of joints
  Vector start;                     ///< of joints
  std::vector<std::string> frames;
  std::vector<std::vector<std::string>> limbs;  ///< frames that pictures join by lines
  int up = 2;                                   ///< axis of the first frame along the spine
  bool paper = false;  ///< torso and two rigid legs on hips XYZ, as [Astronaut] section 4 has it

  std::function<Momentum(const Vector& q, const Vector& v, const Vector& a)> momentum;
  std::function<Vector(const Vector& q, const Vector& v, const Vector& a)> rnea;
  std::function<Matrix(const Vector& q)> crba;
  std::function<Eigen::Vector3d(const Vector& q)> com;
  std::function<Energy(const Vector& q, const Vector& v)> energy;
  std::function<Vector(const Vector& q, const Vector& v)> integrate;
  std::function<std::vector<double>(const Vector& q)> fk;  ///< 12 a frame
  /// Angular velocity of the segment that each joint moves, along the joint's axis, rad/s.
  std::function<Vector(const Vector& q, const Vector& v)> segment_rates;

  int joint(const std::string& wanted) const;  ///< throws std::invalid_argument
  /// Base at the origin, upright; joints as given.
  Vector at_origin(const Vector& joint_angles) const;
};

/// Throws std::invalid_argument with the names there are.
const Model& model(const std::string& name);

}  // namespace self_orientation

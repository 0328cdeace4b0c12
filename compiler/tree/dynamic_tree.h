// The dynamic tree: moving bodies only, every joint axis on z, constants as sparse as they get.
//
// This is what the algorithms run on, with T = double (the generic engine) and T = Expr (the
// traced one).  C++17 without dependencies, because the benchmark compiles it as well.
//
// Frame i is attached to body i, parent(i) < i, body 0 is the world.  A point has coordinates
// x_parent = E x_i + p with
//   revolute   E = R Rz(q)            p = c
//   prismatic  E = R                  p = c + R z q
//   spherical  E = R R(quaternion)    p = c
//   planar     E = R Rz(q2)           p = c + R (q0, q1, 0)
//   floating   E = R R(quaternion)    p = c + R (q0, q1, q2)
// and the constant R = Rz(gamma) Rx(alpha) Rz(theta): each factor costs 4 operations a vector and
// nothing at all where its angle is a multiple of 90 degrees.
#pragma once
#include <string>
#include <vector>

#include "spatial/rotation.h"

namespace arboc {

/// A constant planar rotation.
using Turn = PlanarRotation<double>;

enum class Motion { kWorld, kRevolute, kPrismatic, kPlanar, kFloating, kSpherical };

/// Entries of v that a joint has.
inline int freedoms(Motion motion) {
  switch (motion) {
    case Motion::kWorld: return 0;
    case Motion::kPlanar:
    case Motion::kSpherical: return 3;
    case Motion::kFloating: return 6;
    default: return 1;
  }
}

/// The joint turns its body by a quaternion.
inline bool has_quaternion(Motion motion) {
  return motion == Motion::kFloating || motion == Motion::kSpherical;
}

/// Inertial parameters about the origin of a frame and in its axes: mass, first and second moment,
/// Sigma = integral of r r^T dm.  Rotational inertia = tr(Sigma) 1 - Sigma.
template <class S>
struct MassMomentsOf {
  S m{};                ///< kg
  Vector3<S> h;         ///< kg m
  Symmetric3<S> Sigma;  ///< kg m^2
};
using MassMoments = MassMomentsOf<double>;

/// Where a body hangs and how its joint moves it, without numbers.
struct Body {
  std::string link;   ///< name of the model's link whose joint moves this body
  std::string joint;  ///< name of that joint
  int parent = -1;
  Motion motion = Motion::kWorld;
  int q = -1;             ///< first coordinate in q
  int v = -1;             ///< first coordinate in v, a, tau
  double multiplier = 1;  ///< mimic followers: q_joint = multiplier * q[q] + offset, likewise v, a
  double offset = 0;      ///< m; only prismatic joints keep one, an angle joins theta
  bool circle = false;    ///< revolute: the coordinates are cosine and sine of the angle
  int limbs = 1;  ///< of which this is the root, one a lane; what the parent gets is their sum
};

/// What a joint adds by itself to the force that moves it, along its own rate r of coordinate c:
///   damping r + friction r / sqrt(r^2 + s^2) + stiffness (c - neutral) + rotor dr/dt,
/// s = DynamicTree::friction_velocity.  A joint of several freedoms has no spring.
template <class S>
struct JointForcesOf {
  S damping{};    ///< N m s/rad or N s/m
  S friction{};   ///< N m or N
  S stiffness{};  ///< N m/rad or N/m
  S neutral{};    ///< rad or m
  S rotor{};      ///< kg m^2 or kg
};

/// A body with its numbers.
template <class S>
struct BodyOf : Body {
  PlanarRotation<S> gamma, alpha, theta;  ///< R of the placement above
  Vector3<S> c;                           ///< m, origin in the parent's frame at q = 0
  MassMomentsOf<S> inertia;  ///< of everything welded to this body; regrouped if the tree is
  JointForcesOf<S> forces;   ///< zero unless asked for
};

/// A named link of the model and the body that carries it: x_body = R x_link + p.
template <class S>
struct FrameOf {
  std::string name;
  int body = 0;
  Matrix3<double> R = Matrix3<double>::identity();
  Vector3<S> p;
  bool moving = false;  ///< the child of a non-fixed joint (fk reports these by default)
};

/// The numbers of the tree are of type S: double, or Expr where a parameter of the generated
/// function takes the place of a length, a mass or gravity, or where they differ between lanes.
template <class S>
struct DynamicTreeOf {
  static constexpr int kLargestMatrix = 4096;

  std::string name;
  int nq = 0;
  int nv = 0;
  Vector3<S> gravity{S(0), S(0), S(-9.81)};  ///< m/s^2, world axes
  std::vector<BodyOf<S>> body;               ///< body[0] is the world
  std::vector<FrameOf<S>> frame;             ///< every link, in the model's order
  bool joint_forces = false;                 ///< some body has forces of its joint's own
  double friction_velocity = 0.01;           ///< rad/s or m/s, where friction reaches 71 %
  /// coupled[j]: the indices i < j for which M(i, j), or the fill of its factorisation from the
  /// last row up, can be non-zero, in descending order.  For a tree without mimic joints these are
  /// the ancestors of j.  Empty if nv > kLargestMatrix: such a tree is lowered to be inspected,
  /// and the pattern of a chain grows with nv^2.
  std::vector<std::vector<int>> coupled;

  /// Where bodies stand for several limbs in lanes (functions/lane_tree.h): per coordinate how many
  /// lanes it has.  Empty: no body does.
  std::vector<int> lanes;

  int nb() const { return static_cast<int>(body.size()) - 1; }
};
using DynamicTree = DynamicTreeOf<double>;

/// A number of the tree is zero, or two are equal, whatever the parameters: structure to build on.
inline bool vanishes(double x) { return x == 0; }
inline bool coincide(double x, double y) { return x == y; }

}  // namespace arboc

// The reference engine: the truth that everything else is checked against.
//
// Featherstone's algorithms on the configured model exactly as it was written: every link a body,
// fixed joints kept, any axes, link coordinates, full 6x6 matrices; plain on purpose, and written
// apart from the dynamic tree and the traced recursions so that it cannot share their mistakes.
// Sources: [RBDA] Tables 5.1, 6.2 and 7.1, whose letters v a f I Ic IA pA S D u are used.
// On Complex it is for derivatives, see differentiate.h.
//
// Vectors and matrices are those of the public interface: linear before angular, rates of floating
// and planar joints in the child's frame (accelerations are their component-wise derivatives),
// quaternions x y z w of unit length, mimic followers moved by their leader's coordinate.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "model/model.h"
#include "reference/forces.h"
#include "reference/joint.h"
#include "reference/spatial6.h"

namespace arboc {

template <class S>
class ReferenceOf {
 public:
  using Scalar = S;
  using Vector = VectorOf<S>;
  using Matrix = MatrixOf<S>;

  /// `model` is configured.
  explicit ReferenceOf(const Model& model, const JointForces& forces = {});

  int nq() const { return nq_; }
  int nv() const { return nv_; }

  /// World pose of every link, in the model's order.
  std::vector<PlacementOf<S>> fk(const Vector& q) const;

  /// Joint forces (nv; N or N m) that produce the acceleration `a` against gravity, the joints' own
  /// forces and `loads`.
  Vector rnea(const Vector& q, const Vector& v, const Vector& a, const Loads& loads = {}) const;
  /// rnea(q, 0, 0).
  Vector gravity(const Vector& q) const;
  /// Nonlinear effects, rnea(q, v, 0).
  Vector nle(const Vector& q, const Vector& v, const Loads& loads = {}) const;

  /// Joint-space inertia (nv x nv), full and symmetric; with the rotors if they act.
  Matrix crba(const Vector& q) const;
  /// Its inverse; not finite where the inertia is singular.
  Matrix minv(const Vector& q) const;
  /// Acceleration (nv) under the joint forces `tau`; by the articulated-body algorithm, or with
  /// crba if the model has mimic followers, which close loops that it cannot see.
  Vector aba(const Vector& q, const Vector& v, const Vector& tau, const Loads& loads = {}) const;

  /// Energies in J of what moves, rotors' and springs' included if they act; the potential is 0
  /// where its centre of mass is at the world's origin and all springs are at rest.
  S kinetic(const Vector& q, const Vector& v) const;
  S potential(const Vector& q) const;

  /// q (+) dv: each joint as integrate_joint() says.
  Vector integrate(const Vector& q, const Vector& dv) const;
  /// The dv with q0 (+) dv = q1, each joint as joint_difference() says.
  Vector difference(const Vector& q0, const Vector& q1) const;

  // The mechanism, for the other files of this folder.

  using Vector6 = spatial6::Vector6<S>;
  using Matrix6 = spatial6::Matrix6<S>;
  using Matrices6 = std::vector<Matrix6>;
  using Vectors6 = std::vector<Vector6>;

  /// A link and the joint that carries it; bodies()[0] is the world, bodies()[i] is links[i - 1].
  struct Body {
    int parent = 0;
    Joint joint;            ///< a fixed one welds the root of a fixed base to the world
    PlacementOf<S> T_tree;  ///< of the child's frame in the parent's, at q = 0
    Matrix motion;          ///< S, 6 x nv of the joint
    Coordinates::Entry at;
    bool moves = false;  ///< some joint between it and the world is not fixed
    double m = 0;
    spatial6::Vec3<S> c = spatial6::Vec3<S>::Zero();  ///< centre of mass
    Matrix6 I = Matrix6::Zero();

    /// This joint's entries of v, or of a.
    Vector rates(const Vector& v) const { return at.multiplier * v.segment(at.v, motion.cols()); }
    /// This joint's entries of q.
    Vector positions(const Vector& q) const;
  };

  const std::vector<Body>& bodies() const { return bodies_; }
  int nb() const { return static_cast<int>(bodies_.size()) - 1; }
  /// X[i]: motion vectors from the parent of i to i.
  Matrices6 transforms(const Vector& q) const;
  /// Of each body, in its own frame; X by transforms().
  Vectors6 velocities(const Matrices6& X, const Vector& v) const;
  /// Likewise where the world has the acceleration `a0`.
  Vectors6 accelerations(const Matrices6& X, const Vectors6& velocity, const Vector& v,
                         const Vector& a, const Vector6& a0) const;
  /// What the wrenches do to each body, in its own frame.
  Vectors6 applied(const Vector& q, const Loads& loads) const;
  /// Gravity as an acceleration of the world.
  Vector6 rising() const;

 private:
  /// What the inward sweep of Table 7.1 leaves for the outward one.
  struct Articulated;

  PlacementOf<S> placement(const Body& body, const Vector& q) const;
  /// The forces of the joints as they stand and move, by their own coordinates.
  Vector passive(const Body& body, const Vector& q, const Vector& v) const;
  double rotor(const Body& body) const { return forces_.rotor ? body.joint.rotor_inertia : 0; }
  Articulated articulated_inertias(const Matrices6& X, const Vectors6& pA, const Vectors6& c,
                                   const Vector& tau) const;
  Vector articulated_body(const Vector& q, const Vector& v, const Vector& tau,
                          const Loads& loads) const;

  std::vector<Body> bodies_;
  JointForces forces_;
  Eigen::Vector3d gravity_;
  int nq_ = 0;
  int nv_ = 0;
  bool mimic_ = false;
};

using Reference = ReferenceOf<double>;
using ComplexReference = ReferenceOf<Complex>;

}  // namespace arboc

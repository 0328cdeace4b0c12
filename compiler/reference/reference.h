// The reference engine: the truth that everything else is checked against.
//
// Featherstone's algorithms on the configured model exactly as it was written: every link a body,
// fixed joints kept, any axes, link coordinates, full 6x6 matrices; plain on purpose, and written
// apart from the dynamic tree and the traced recursions so that it cannot share their mistakes.
// Sources: [RBDA] Tables 5.1, 6.2 and 7.1, whose letters v a f I Ic IA pA S D u are used.
//
// Vectors and matrices are those of the public interface: linear before angular, rates of floating
// and planar joints in the child's frame (accelerations are their component-wise derivatives),
// quaternions x y z w of unit length, mimic followers moved by their leader's coordinate.
#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "model/model.h"
#include "reference/joint.h"
#include "reference/spatial6.h"

namespace arboc {

class Reference {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  /// `model` is configured.
  explicit Reference(const Model& model);

  int nq() const { return nq_; }
  int nv() const { return nv_; }

  /// World pose of every link, in the model's order.
  std::vector<Placement> fk(const Vector& q) const;

  /// Joint forces (nv; N or N m) that produce the acceleration `a` against gravity.
  Vector rnea(const Vector& q, const Vector& v, const Vector& a) const;
  /// rnea(q, 0, 0).
  Vector gravity(const Vector& q) const;
  /// Nonlinear effects, rnea(q, v, 0).
  Vector nle(const Vector& q, const Vector& v) const;

  /// Joint-space inertia (nv x nv), full and symmetric.
  Matrix crba(const Vector& q) const;
  /// Its inverse; not finite where the inertia is singular.
  Matrix minv(const Vector& q) const;
  /// Acceleration (nv) under the joint forces `tau`; by the articulated-body algorithm, or with
  /// crba if the model has mimic followers, which close loops that it cannot see.
  Vector aba(const Vector& q, const Vector& v, const Vector& tau) const;

  /// Energies in J; the potential is 0 where all centres of mass are at the world's origin.
  double kinetic(const Vector& q, const Vector& v) const;
  double potential(const Vector& q) const;

  /// q (+) dv: each joint as integrate_joint() says.
  Vector integrate(const Vector& q, const Vector& dv) const;

 private:
  /// A link and the joint that carries it; bodies_[0] is the world, bodies_[i] is links[i - 1].
  struct Body {
    int parent = 0;
    Joint joint;       ///< a fixed one welds the root of a fixed base to the world
    Placement T_tree;  ///< of the child's frame in the parent's, at q = 0
    Matrix S;
    Coordinates::Entry at;
    double m = 0;
    Eigen::Vector3d c = Eigen::Vector3d::Zero();  ///< centre of mass
    spatial6::Matrix6 I = spatial6::Matrix6::Zero();

    /// This joint's entries of v, or of a.
    Vector rates(const Vector& v) const { return at.multiplier * v.segment(at.v, S.cols()); }
  };
  using Matrices6 = std::vector<spatial6::Matrix6>;
  using Vectors6 = std::vector<spatial6::Vector6>;
  /// What the inward sweep of Table 7.1 leaves for the outward one, per body.
  struct Articulated {
    std::vector<Matrix> U;              ///< IA S
    std::vector<Eigen::LLT<Matrix>> D;  ///< S^T U, factored
    std::vector<Vector> u;              ///< tau - S^T pA
  };

  int nb() const { return static_cast<int>(bodies_.size()) - 1; }
  Placement placement(const Body& body, const Vector& q) const;
  Matrices6 transforms(const Vector& q) const;
  Vectors6 velocities(const Matrices6& X, const Vector& v) const;
  Articulated articulated_inertias(const Matrices6& X, const Vectors6& v, const Vectors6& c,
                                   const Vector& tau) const;
  Vector articulated_body(const Vector& q, const Vector& v, const Vector& tau) const;

  std::vector<Body> bodies_;
  Eigen::Vector3d gravity_;
  int nq_ = 0;
  int nv_ = 0;
  bool mimic_ = false;
};

}  // namespace arboc

// Curves in time whose control points are variables of a problem or fixed.
#pragma once
#include <Eigen/Core>
#include <arboc/motion/basis_matrix.hpp>
#include <arboc/nlp/problem.hpp>

namespace motion {

/// How a body moves at an instant.
struct State {
  Eigen::VectorXd q, v, a;
  Eigen::VectorXd reactions;  ///< six a contact, along the contact's axes
};

/// The first three control points (columns) of coordinates that begin so, or the last three of
/// those that end so; all but the innermost one do not depend on accelerations.
Eigen::MatrixXd end_points(const arboc::BSplineBasis& basis, const State& state, bool at_end);

/// The first three control points on `next` of what the last three on `before` end with, as rows of
/// factors: value and two derivatives are the same.
Eigen::Matrix3d linked_points(const arboc::BSplineBasis& before, const arboc::BSplineBasis& next);

/// Basis values and derivatives of some orders at an instant.
struct BasisAt {
  int first = 0;           ///< control point of the first column
  Eigen::MatrixXd values;  ///< order x (degree + 1)
};
BasisAt basis_at(const arboc::BSplineBasis& basis, double t, int order);

/// Control points by coordinate: `points[j][i]`.
struct ControlPoints {
  std::vector<std::vector<arboc::nlp::Affine>> points;

  /// The k-th derivative of coordinate j.
  arboc::nlp::Affine operator()(int j, const BasisAt& at, int k) const;
  std::vector<arboc::nlp::Affine> all(const BasisAt& at, int k) const;
};

/// Numbers of a solution.
Eigen::MatrixXd values_of(const ControlPoints& points, const std::vector<double>& x);
/// Into the variables among them; points that are sums of those follow.
void set_values(const ControlPoints& points, const Eigen::MatrixXd& values, std::vector<double>& x);

}  // namespace motion

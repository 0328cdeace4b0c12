// Curves in time whose control points are variables of a problem or fixed.
#pragma once
#include <Eigen/Core>
#include <arboc/motion/basis_matrix.hpp>
#include <arboc/nlp/problem.hpp>

namespace motion {

/// Coordinates at an end: value, first and second derivative.
struct EndState {
  Eigen::VectorXd value, first, second;
};

/// The first three control points (columns) of curves that begin so, or the last three of curves
/// that end so.
Eigen::MatrixXd end_points(const arboc::BSplineBasis& basis, const EndState& state, bool at_end);

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
/// Into the variables among them.
void set_values(const ControlPoints& points, const Eigen::MatrixXd& values, std::vector<double>& x);

}  // namespace motion

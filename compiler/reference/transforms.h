// Homogeneous transforms of links and their derivatives, by products of 4x4 matrices.
//
// [Thesis] (2.2)-(2.10) as it stands: T = T_1 T_2 ... T_n from the world to the link, one factor a
// joint, and a derivative puts the factors' own derivatives in their places.  A joint moved by d
// has the factor T_i exp([S_i d]), [s] = [w]x v; 0 0 the 4x4 matrix of a twist, so
//     dT_i = T_i [s],   d2T_i = T_i ([s][s'] + [s'][s]) / 2,   d3T_i: the mean over all six orders,
// which for a joint of one coordinate is T_i [s]^k, the derivatives of its angle or length.  Plain
// on purpose: this is the truth for `transforms` and what Lagrange's form is made of.
#pragma once
#include "reference/reference.h"

namespace arboc {

template <class S>
using Matrix4 = Eigen::Matrix<S, 4, 4>;

template <class S>
class TransformsOf {
 public:
  TransformsOf(const ReferenceOf<S>& reference, const VectorOf<S>& q, int link);

  /// Coordinates (indices into v) that move the link, increasing.
  const std::vector<int>& coordinates() const { return coordinates_; }

  Matrix4<S> T() const { return between(0, size()); }
  /// (2.6), without a general inverse.
  Matrix4<S> inverse() const;
  /// Derivatives along coordinates, in any order; zero where one does not move the link.
  Matrix4<S> derivative(const std::vector<int>& along) const;

 private:
  /// A way in which one coordinate moves the link: a factor's generator, times the multiplier.
  struct Step {
    int factor, coordinate;
    Matrix4<S> generator;
  };

  int size() const { return static_cast<int>(factors_); }
  /// The product of the factors from + 1 ... to.
  const Matrix4<S>& between(int from, int to) const {
    return products_[static_cast<size_t>(from) * (factors_ + 1) + static_cast<size_t>(to)];
  }
  Matrix4<S> product(std::vector<const Step*> steps) const;

  size_t factors_ = 0;
  std::vector<Matrix4<S>> products_;
  std::vector<Step> steps_;
  std::vector<int> coordinates_;
};

}  // namespace arboc

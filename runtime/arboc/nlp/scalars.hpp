// Scalar functions of a few arguments, with their derivatives, for rows and costs.
#ifndef ARBOC_NLP_SCALARS_HPP
#define ARBOC_NLP_SCALARS_HPP

#include <Eigen/Core>
#include <memory>

#include "function.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

using ScalarPointer = std::shared_ptr<const Scalar>;

/// z^2.
ScalarPointer square();
/// z^T Q z / 2; Q symmetric.
ScalarPointer quadratic(const Eigen::MatrixXd& Q);
/// a^T b of two vectors of n entries, first all of a.
ScalarPointer dot(int n);
/// |a|^2 of n entries.
ScalarPointer squared_norm(int n);
/// sqrt(|a|^2 + e^2) of n entries: at most e more than the norm, and smooth at 0.
ScalarPointer rounded_norm(int n, double e);
/// Normalised torque squared, [Thesis] (5.5): (z/upper)^2 where z >= 0, (z/lower)^2 where z < 0.
ScalarPointer normalised_square(double lower, double upper);
/// { sum (n_i^2 + 1)^p }^(1/p) of normalised torques, [Thesis] (5.7).
ScalarPointer normalised_norm(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, double p);
/// 1 - cosine of the angle between a unit vector a (3) and u (3), any length: 0 to 2.
ScalarPointer off_direction();

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_SCALARS_HPP

// Derivatives of the reference engine by differences: slow, plain, and sharing nothing with the
// recursions that they check.
#pragma once
#include "reference/reference.h"

namespace arboc {

struct RneaState {
  Eigen::VectorXd q, v, a;
};

struct RneaDerivative {
  Eigen::MatrixXd dtau_dq;  ///< nv x nv; of tau(q (+) d, v, a) with respect to d at d = 0
  Eigen::MatrixXd dtau_dv;  ///< nv x nv
};

/// dtau_dq by a central stencil of six points along Reference::integrate, off by the step's sixth
/// power and by rounding over the step: some 1e-12 of the largest force each.  dtau_dv by two
/// points, which is exact up to rounding because tau is a quadratic function of v.
RneaDerivative differentiate_rnea(const Reference& reference, const Model& model,
                                  const RneaState& state);

}  // namespace arboc

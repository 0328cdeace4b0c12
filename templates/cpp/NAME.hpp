@banner@
//
// Eigen interface of @name@.
#pragma once

#include <Eigen/Core>

#include "@name@_raw.hpp"

namespace @name@ {

using Config = Eigen::Matrix<double, nq, 1>;   ///< q
using Tangent = Eigen::Matrix<double, nv, 1>;  ///< v, a, tau
@vector_alias@/// nv x nv; on the heap where it would be too large for the stack.
using Matrix = Eigen::Matrix<double, (nv <= 64 ? nv : Eigen::Dynamic), (nv <= 64 ? nv : Eigen::Dynamic)>;

@functions@}  // namespace @name@

// Wrenches that act on links from outside.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "model/joint_forces.h"
#include "model/model.h"

namespace arboc {

/// What acts on a link from outside.
struct LinkWrench {
  int link = -1;  ///< index into Model::links
  /// Where moments are taken about, and along which axes: of the link's frame.
  Axes axes = Axes::kLocal;
  Eigen::Matrix<double, 6, 1> wrench;  ///< force, N, then moment, N m
};
using Loads = std::vector<LinkWrench>;

}  // namespace arboc

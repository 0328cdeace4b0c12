// Random models, and plain dynamics on the model as written to compare lowered trees with.
//
// The dynamics keep fixed joints, arbitrary axes and link frames: 6x6 spatial vectors (angular
// first, [RBDA] Table 5.1), so they share no formula with what they check.
#pragma once
#include <Eigen/Dense>
#include <random>
#include <vector>

#include "model/model.h"

namespace arboc::test {

struct RandomModelOptions {
  int joints = 10;
  bool aligned = false;       ///< placements by quarter turns, axes along +-x, +-y, +-z
  bool many_freedoms = true;  ///< planar and floating joints below others
  bool mimic = true;
  bool every_link_has_mass = false;
  Base base = Base::kFixed;
};

/// Configured, without snapping.
Model random_model(unsigned seed, const RandomModelOptions& options);

/// Motion with unit quaternions.
struct State {
  std::vector<double> q, v, a;
};
State random_state(const Model& model, unsigned seed);

Eigen::VectorXd spatial_rnea(const Model& model, const State& state);
/// Columns of M by inverse dynamics at unit accelerations without gravity.
Eigen::MatrixXd spatial_inertia(Model model, const State& state);
/// Per link the pose in the world.
std::vector<Eigen::Isometry3d> placements(const Model& model, const State& state);

}  // namespace arboc::test

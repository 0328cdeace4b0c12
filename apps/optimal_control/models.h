// Bodies whose generated code the program contains, with derivatives of their torques.
#pragma once
#include <arboc/nlp/function.hpp>
#include <memory>

#include "common/fixed_model.h"

namespace optimal_control {

using Vector = Eigen::VectorXd;

struct Model : study::FixedModel {
  std::shared_ptr<arboc::nlp::Function> torques;     ///< q, v, a -> tau
  std::shared_ptr<arboc::nlp::Function> placements;  ///< q -> 12 a frame
  std::vector<std::vector<std::string>> limbs;       ///< frames that pictures join by lines
};

/// Throws std::invalid_argument with the names there are.
const Model& model(const std::string& name);

}  // namespace optimal_control

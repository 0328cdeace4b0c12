// Random states of a model.
#pragma once
#include <Eigen/Core>

#include "model/model.h"
#include "support/random.h"

namespace arboc::test {

struct State {
  Eigen::VectorXd q;          ///< nq; angles within +-pi (+-1 of joints with several axes), lengths
                              ///< within +-1 m, unit quaternions
  Eigen::VectorXd v, a, tau;  ///< nv; within +-2, +-5 and +-10
};

State random_state(const Model& model, Random& random);

}  // namespace arboc::test

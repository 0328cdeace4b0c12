// Velocities of a body that holds on: of contacts from those of coordinates, and back.
#pragma once
#include <map>

#include <posture/models.h>

#include "curve.h"
#include "task.h"

namespace motion {

/// What a velocity at an end has to respect.
struct RateLimits {
  std::vector<arboc::nlp::Contact> contacts{};  ///< that do not move
  double reach = 0;  ///< s: for so long before and after, coordinates stay in their limits
};

/// The velocities that `given` prescribes, by coordinate, and of all others those with the least
/// kinetic energy such that contacts do not move; zero where none is given.  Throws
/// std::invalid_argument, which begins with `what`, and says which contact would move, and how
/// fast, or which limit a coordinate would leave.
Eigen::VectorXd complete_velocity(const posture::Model& model, const Eigen::VectorXd& q,
                                  const std::map<std::string, double>& given,
                                  const RateLimits& limits, const std::string& what);

}  // namespace motion

// What a motion costs over its frames: the five measures of energy expenditure, largest torques.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "csv.h"

namespace study {

/// A row a frame, a column a joint.
struct Effort {
  std::vector<double> times;  ///< s
  Rows torques;               ///< N m
  Rows rates;                 ///< of joints, rad/s
  Rows segment_rates;         ///< of the segments that joints move, along their axes, rad/s
  Rows accelerations;         ///< rad/s^2
  Eigen::VectorXd energies;   ///< kinetic, J

  Effort(std::size_t frames, std::size_t joints);
  Eigen::VectorXd time_column() const;
};

/// sum of |tau|, a third where the joint gives way, in each frame; [Astronaut] Figure 15.  N m
Eigen::VectorXd weighted_torques(const Effort& effort);

/// effort (N m s), exchange (J), power (J), transfer (J), jerk (rad/s^2): integrals by trapezoids,
/// of jerk the sum of changes of accelerations.
std::map<std::string, double> expenditure(const Effort& effort);

/// Of a joint, where |tau| is largest.
struct Peak {
  std::string joint;
  double torque = 0, time = 0;  ///< N m, s
};
std::vector<Peak> peaks(const std::vector<std::string>& joints, const Effort& effort);
std::string peaks_csv(const std::vector<Peak>& peaks);

}  // namespace study

// What a motion does at many instants, frames or not: from its curves alone, by the robot's
// dynamics and placements, without the problem that it came from.
#pragma once
#include "build.h"

namespace motion {

/// States in time, one row an instant.
struct Samples {
  Eigen::VectorXd t;
  Eigen::MatrixXd q, v, a;     ///< coordinates
  Eigen::MatrixXd tau;         ///< what drives are asked for; passive ones: what is missing there
  Eigen::MatrixXd reactions;   ///< six a contact: force and moment on the body at the point, world
  Eigen::MatrixXd placements;  ///< twelve a frame
};
Samples sample(const Task& task, const Model& model, const Motion& motion, int count);

/// The largest torque over its limit in a state.
double largest_normalised(const Task& task, const Model& model, const State& state);
/// Instants between the ends at which a torque over its limit is largest for a while, and `above`.
std::vector<double> torque_peaks(const Model& model, const Samples& samples, double above);

/// Coordinates that move without turning: their forces are in N.
std::vector<bool> translations(const Model& model);

/// Means over time of the measures of the objective, unweighted, and the largest ones.
std::map<std::string, double> measures(const Task& task, const Model& model, const Motion& motion,
                                       const Samples& samples);

}  // namespace motion

// Result -> files.
#pragma once
#include <string>

#include "predict.h"

namespace posture {

/// result.json: everything, numbers with 17 digits.
std::string json_text(const Task& task, const Model& model, const Result& result);
/// One row a coordinate: posture, limits, torque, limits, normalised.
std::string coordinates_csv(const Model& model, const Result& result);
/// One row a contact: force and moment on the body at its point, world axes.
std::string reactions_csv(const Task& task, const Result& result);
/// One row a start.
std::string starts_csv(const Result& result);
/// The skeleton from three sides with forces, torques against their limits, tables.
std::string page(const Task& task, const Model& model, const Result& result);

/// The number below which `part` of them lie, 0 to 1; 0 of none.
double quantile(std::vector<double> x, double part);

}  // namespace posture

// Result -> files.
#pragma once
#include <optional>

#include "aim.h"
#include "common/page.h"
#include "report.h"

namespace self_orientation {

/// result.json: numbers with 17 digits.
std::string json_text(const Model& model, const Task& task, const Result& result,
                      const std::optional<AimResult>& aim);
/// A row a frame: time, coordinates, velocities, torques.
std::string motion_csv(const Model& model, const Result& result);
study::Animation animation(const Model& model, const Task& task, const Result& result);
study::Plot torque_plot(const Model& model, const Task& task, const Result& result);
study::Plot heading_plot(const Model& model, const Result& result);
study::Page page(const Model& model, const Task& task, const Result& result,
                 const study::Animation& animation);

}  // namespace self_orientation

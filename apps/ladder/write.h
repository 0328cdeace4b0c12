// Result -> files.
#pragma once
#include "common/page.h"
#include "report.h"

namespace ladder {

/// result.json: numbers with 17 digits.
std::string json_text(const Task& task, const Result& result);
/// A row a frame: time, angles, rates, torques, forces on the hands.
std::string motion_csv(const Result& result);
/// A row a period.
std::string schedule_csv(const Result& result);
/// [Astronaut] Figure 15.
study::Plot weighted_plot(const Result& result);
study::Plot torque_plot(const Result& result);
study::Page page(const Task& task, const Result& result);

}  // namespace ladder

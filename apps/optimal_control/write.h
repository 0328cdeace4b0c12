// Result -> files.
#pragma once
#include "common/page.h"
#include "report.h"

namespace optimal_control {

/// result.json: of the first answer at the top, then all of them; numbers with 17 digits.
std::string json_text(const std::string& task, const Question& question, const Result& result);
/// A row a frame: time, angles, rates, torques of the first answer.
std::string motion_csv(const Question& question, const Result& result);
/// A row an iteration of the Lagrange-Newton method.
std::string log_csv(const Answer& answer);
study::Animation animation(const std::string& task, const Question& question, const Result& result);
/// Sum of tau^2 over time, before and after; torques after.
std::vector<study::Plot> plots(const Question& question, const Result& result);
study::Page page(const std::string& task, const Question& question, const Result& result,
                 const study::Animation& animation);

}  // namespace optimal_control

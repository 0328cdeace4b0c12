// Answers beside the quintic that they began from: torques, energy expenditure.
#pragma once
#include "common/expenditure.h"
#include "plan.h"

namespace optimal_control {

/// A motion in frames.
struct Played {
  std::vector<double> times;
  study::Rows q;  ///< frames x joints
  study::Effort effort;
  std::map<std::string, double> energy;
  double cost = 0;  ///< Int sum tau^2 dt
};
Played play(const study::FixedModel& model, const Known& motion, double duration, double rate);

struct Result {
  Played before;  ///< the quintic, to the end that the first answer found
  std::vector<Answer> answers;
  std::vector<Played> after;  ///< one an answer
};
/// `plan`: what is known already; otherwise quintics from start to end.
Result report(const Question& question, const std::vector<Method>& methods, double rate,
              const Known& plan = {});

}  // namespace optimal_control

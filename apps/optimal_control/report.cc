#include "report.h"

#include <cmath>

namespace optimal_control {

Played play(const study::FixedModel& model, const Known& motion, double duration, double rate) {
  const int frames = std::max(2, static_cast<int>(std::lround(duration * rate)) + 1);
  const auto n = static_cast<std::size_t>(model.size());
  Played out{{}, study::Rows(frames, model.size()), study::Effort(frames, n), {}, 0};
  Vector q, v, a, tau, segment;
  for (int k = 0; k < frames; ++k) {
    const double t = duration * k / (frames - 1);
    motion(t, q, v, a);
    model.rnea(q, v, a, tau);
    model.segment_rates(q, v, segment);
    out.effort.times[static_cast<std::size_t>(k)] = t;
    out.q.row(k) = q.transpose();
    out.effort.torques.row(k) = tau.transpose();
    out.effort.rates.row(k) = v.transpose();
    out.effort.segment_rates.row(k) = segment.transpose();
    out.effort.accelerations.row(k) = a.transpose();
    out.effort.energies[k] = model.kinetic_energy(q, v);
  }
  out.times = out.effort.times;
  out.energy = study::expenditure(out.effort);
  out.cost = torque_cost(model, motion, duration);
  return out;
}

Result report(const Question& question, const std::vector<Method>& methods, double rate,
              const Known& plan) {
  Result r{play(*question.model, known({question.basis, question.guess}), question.duration, rate),
           {},
           {}};
  for (const Method method : methods) {
    r.answers.push_back(solve(question, method));
    r.after.push_back(
        play(*question.model, known(r.answers.back().motion), question.duration, rate));
  }
  if (plan) {
    r.before = play(*question.model, plan, question.duration, rate);
  } else if (!r.answers.empty()) {
    const arboc::BSpline& motion = r.answers[0].motion;
    r.before =
        play(*question.model, quintic(motion(0), motion(question.duration), question.duration),
             question.duration, rate);
  }
  return r;
}

}  // namespace optimal_control

#include "manoeuvre.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace self_orientation {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

void set(const Model& model, const std::map<std::string, double>& angles, Vector& q) {
  for (const auto& [name, angle] : angles) {
    const int j = model.joint(name);
    if (angle < model.q_lower[j] - 1e-12 || angle > model.q_upper[j] + 1e-12)
      throw std::invalid_argument(
          fmt::format("{}: {:.4g} deg is outside its limits [{:.4g}, {:.4g}]", name,
                      angle / kDegree, model.q_lower[j] / kDegree, model.q_upper[j] / kDegree));
    q[j] = angle;
  }
}

}  // namespace

Manoeuvre::Manoeuvre(const Task& task, const Model& model) {
  Vector start = model.start;
  set(model, task.start, start);
  std::vector<Vector> postures = {start};
  std::vector<double> durations;
  for (int cycle = 0; cycle < task.cycles; ++cycle)
    for (const Step& step : task.steps) {
      Vector q = step.home ? start : postures.back();
      set(model, step.q, q);
      postures.push_back(q);
      durations.push_back(step.duration * task.time_scale);
    }
  if (task.reverse) {
    std::reverse(postures.begin(), postures.end());
    std::reverse(durations.begin(), durations.end());
  }
  for (std::size_t k = 0; k < durations.size(); ++k) {
    paths_.push_back(
        arboc::MotionPath::quintic({postures[k], postures[k + 1], ends_.back(), durations[k]}));
    ends_.push_back(ends_.back() + durations[k]);
  }
}

arboc::MotionPath::Sample Manoeuvre::operator()(double t) const {
  const auto after = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, t);
  return paths_[static_cast<std::size_t>(after - ends_.begin()) - 1](t);
}

}  // namespace self_orientation

#include <fmt/format.h>

#include "write.h"

namespace posture {

std::string coordinates_csv(const Model& model, const Result& result) {
  const arboc::nlp::Robot& r = model.robot;
  std::string out = "coordinate,q,q_lower,q_upper,tau,tau_lower,tau_upper,normalised\n";
  for (std::size_t i = 0; i < result.q.size(); ++i) {
    const double tau = result.tau[i], limit = tau < 0 ? r.tau_lower[i] : r.tau_upper[i];
    out += fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n",
                       r.coordinates[i], result.q[i], r.q_lower[i], r.q_upper[i], tau,
                       r.tau_lower[i], r.tau_upper[i], model.passive[i] ? 0 : tau / limit);
  }
  return out;
}

std::string reactions_csv(const Task& task, const Result& result) {
  std::string out = "contact,Fx,Fy,Fz,Mx,My,Mz\n";
  for (std::size_t c = 0; c < result.reactions.size(); ++c) {
    out += task.contacts[c].name;
    for (const double x : result.reactions[c]) out += fmt::format(",{:.17g}", x);
    out += '\n';
  }
  return out;
}

std::string starts_csv(const Result& result) {
  std::string out = "start,status,objective,iterations,restarts,seconds,cpu_seconds,violation\n";
  for (std::size_t k = 0; k < result.starts.size(); ++k) {
    const Start& s = result.starts[k];
    out += fmt::format("{},{},{:.17g},{},{},{:.6f},{:.6f},{:.3g}\n", k, text(s.status), s.objective,
                       s.iterations, s.restarts, s.seconds, s.cpu_seconds, s.violation);
  }
  return out;
}

}  // namespace posture

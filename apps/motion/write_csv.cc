#include "common/csv.h"
#include "write.h"

namespace motion {

std::string trajectory_csv(const Model& model, const Result& result) {
  std::vector<std::string> names{"t"};
  for (const char* what : {"", "v ", "a ", "tau "}) {
    const std::vector<std::string> block = study::prefixed(what, model.robot.coordinates);
    names.insert(names.end(), block.begin(), block.end());
  }
  const Samples& s = result.samples;
  return study::csv(names, {s.t, s.q, s.v, s.a, s.tau});
}

std::string reactions_csv(const Task& task, const Result& result) {
  std::vector<std::string> names{"t"};
  for (const arboc::nlp::Contact& c : task.start.posture.contacts) {
    const std::vector<std::string> block =
        study::prefixed(c.name + " ", {"Fx", "Fy", "Fz", "Mx", "My", "Mz"});
    names.insert(names.end(), block.begin(), block.end());
  }
  return study::csv(names, {result.samples.t, result.samples.reactions});
}

}  // namespace motion

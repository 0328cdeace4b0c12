#include "robot.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

int find(const std::vector<std::string>& names, const std::string& wanted, const std::string& what,
         const std::string& hint) {
  const auto at = std::find(names.begin(), names.end(), wanted);
  if (at != names.end()) return static_cast<int>(at - names.begin());
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  throw std::invalid_argument(what + " '" + wanted + "' is not among those generated: " + list +
                              hint);
}

}  // namespace

int Robot::coordinate(const std::string& wanted) const {
  return find(coordinates, wanted, "coordinate", "");
}
int Robot::frame(const std::string& wanted) const {
  return find(frames, wanted, "frame",
              "; to have it, add it to `arboc compile ... --frames` of " + name);
}
int Robot::load(const std::string& wanted) const {
  return find(loads, wanted, "loaded frame",
              "; to have it, add it to `arboc compile ... --external-forces` of " + name);
}

Robot robot_of(const RobotTables& t, std::shared_ptr<Function> placements,
               std::shared_ptr<Function> statics) {
  if (t.nq != t.nv)
    throw std::invalid_argument(std::string(t.name) +
                                ": coordinates are not single; generate it with --expand");
  Robot robot;
  robot.name = t.name;
  robot.coordinates.assign(t.coordinates, t.coordinates + t.nv);
  robot.q_lower.assign(t.q_lower, t.q_lower + t.nq);
  robot.q_upper.assign(t.q_upper, t.q_upper + t.nq);
  robot.tau_upper.assign(t.tau_upper, t.tau_upper + t.nv);
  robot.tau_lower.assign(t.tau_lower, t.tau_lower + t.nv);
  robot.frames.assign(t.frames, t.frames + t.frame_count);
  robot.loads.assign(t.loads, t.loads + t.load_count);
  robot.placements = std::move(placements);
  robot.statics = std::move(statics);
  return robot;
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

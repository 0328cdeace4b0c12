// Result -> files of other programs: coordinates, torques and reactions for OpenSim, frames as
// markers.
#include "write.h"

namespace motion {

Recording coordinates_recording(const Model& model, const Result& result) {
  const std::vector<bool> translation = translations(model);
  Recording out{"coordinates", model.robot.coordinates, result.samples.t, result.samples.q, true};
  for (std::size_t i = 0; i < translation.size(); ++i)
    if (!translation[i])
      out.values.col(static_cast<Eigen::Index>(i)) *= 180 / 3.14159265358979323846;
  return out;
}

Recording torques_recording(const Model& model, const Result& result) {
  Recording out{"torques", {}, result.samples.t, {}, false};
  std::vector<Eigen::Index> chosen;
  for (std::size_t i = 0; i < model.passive.size(); ++i) {
    if (model.passive[i]) continue;
    out.columns.push_back(model.robot.coordinates[i]);
    chosen.push_back(static_cast<Eigen::Index>(i));
  }
  out.values = result.samples.tau(Eigen::all, chosen);
  return out;
}

Recording reactions_recording(const Task& task, const Model& model, const Result& result) {
  const Samples& s = result.samples;
  const auto& contacts = task.start.posture.contacts;
  Recording out{"reactions", {}, s.t, {}, false};
  out.values.resize(s.t.size(), static_cast<Eigen::Index>(9 * contacts.size()));
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for (const char* what : {"_force_vx", "_force_vy", "_force_vz", "_force_px", "_force_py",
                             "_force_pz", "_torque_x", "_torque_y", "_torque_z"})
      out.columns.push_back(contacts[c].name + what);
    const auto from = static_cast<Eigen::Index>(6 * c), to = static_cast<Eigen::Index>(9 * c);
    const int frame = 12 * model.robot.frame(contacts[c].frame);
    out.values.middleCols<3>(to) = s.reactions.middleCols<3>(from);
    out.values.middleCols<3>(to + 6) = s.reactions.middleCols<3>(from + 3);
    for (Eigen::Index k = 0; k < s.t.size(); ++k)
      for (int i = 0; i < 3; ++i)
        out.values(k, to + 3 + i) =
            s.placements.row(k).segment<3>(frame + 3 * i).dot(contacts[c].point.transpose()) +
            s.placements(k, frame + 9 + i);
  }
  return out;
}

Recording markers_recording(const Task& task, const Model& model, const Result& result) {
  const Samples& s = result.samples;
  const std::vector<std::string>& frames = model.robot.frames;
  Recording out{task.name + ".trc", {}, s.t, {}, false};
  out.values.resize(s.t.size(), static_cast<Eigen::Index>(3 * frames.size()));
  for (std::size_t f = 0; f < frames.size(); ++f) {
    for (const char* axis : {" x", " y", " z"}) out.columns.push_back(frames[f] + axis);
    out.values.middleCols<3>(static_cast<Eigen::Index>(3 * f)) =
        s.placements.middleCols<3>(static_cast<Eigen::Index>(12 * f + 9));
  }
  return out;
}

}  // namespace motion

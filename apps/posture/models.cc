#include "models.h"

#include <cmath>
#include <humanoid/humanoid_batch.hpp>
#include <humanoid_motion/humanoid_motion_batch.hpp>
#include <map>
#include <nine_dof/nine_dof_batch.hpp>
#include <nine_dof_motion/nine_dof_motion_batch.hpp>
#include <santos/santos_batch.hpp>
#include <santos_motion/santos_motion_batch.hpp>
#include <stdexcept>

namespace posture {
namespace {

using arboc::nlp::Robot;

constexpr int kLanes = 4;  ///< of what motions call: SCALARS in CMakeLists.txt

/// Coordinates before the first torque that has a limit move the body as a whole.
std::vector<bool> passive_until_limited(const Robot& robot) {
  std::vector<bool> passive(static_cast<std::size_t>(robot.size()), false);
  for (std::size_t i = 0; i < passive.size() && !std::isfinite(robot.tau_upper[i]); ++i)
    passive[i] = true;
  return passive;
}

template <std::size_t N>
std::vector<double> list(const double (&table)[N]) {
  return {table, table + N};
}

Model santos_model() {
  Model m;
  m.robot = ARBOC_NLP_ROBOT(santos);
  m.robot.dynamics = ARBOC_NLP_DYNAMICS(santos_motion, kLanes);
  m.robot.postures["relaxed"] = list(santos::q_relaxed);
  m.passive = passive_until_limited(m.robot);
  m.limbs = {{"hip", "z3", "z6", "z9", "z12", "z13", "z14", "z17", "z19", "r_hand"},
             {"z9", "z22", "z23", "z24", "z27", "z29", "l_hand"},
             {"z9", "z32", "z35", "head"},
             {"hip", "z38", "z41", "z42", "z45"},
             {"z42", "r_heel", "z45"},
             {"hip", "z46", "z49", "z50", "z53"},
             {"z50", "l_heel", "z53"}};
  return m;
}

Model nine_dof_model() {
  Model m;
  m.robot = ARBOC_NLP_ROBOT(nine_dof);
  m.robot.dynamics = ARBOC_NLP_DYNAMICS(nine_dof_motion, kLanes);
  m.robot.postures["start"] = list(nine_dof::q_start);
  m.passive = passive_until_limited(m.robot);
  m.limbs = {{"trunk", "r_shoulder", "r_upper_arm", "r_lower_arm", "r_hand"},
             {"trunk", "l_shoulder", "l_upper_arm", "l_lower_arm", "l_hand"}};
  return m;
}

Model humanoid_model() {
  Model m;
  m.robot = ARBOC_NLP_ROBOT(humanoid);
  m.robot.dynamics = ARBOC_NLP_DYNAMICS(humanoid_motion, kLanes);
  m.passive = passive_until_limited(m.robot);
  m.up = 2;
  m.limbs = {{"pelvis", "thorax", "head"},
             {"head", "left_upper_arm", "left_forearm", "left_hand"},
             {"head", "right_upper_arm", "right_forearm", "right_hand"},
             {"pelvis", "left_thigh", "left_shank", "left_foot"},
             {"pelvis", "right_thigh", "right_shank", "right_foot"}};
  return m;
}

}  // namespace

const Model& model(const std::string& name) {
  static const std::map<std::string, Model> models = {
      {"humanoid", humanoid_model()}, {"nine_dof", nine_dof_model()}, {"santos", santos_model()}};
  const auto at = models.find(name);
  if (at != models.end()) return at->second;
  std::string known;
  for (const auto& [other, model] : models) known += (known.empty() ? "" : ", ") + other;
  throw std::invalid_argument("there is no model '" + name + "'; those in this program are " +
                              known + " (apps/posture/CMakeLists.txt and models.cc add others)");
}

}  // namespace posture

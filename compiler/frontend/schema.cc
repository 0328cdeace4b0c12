#include "frontend/schema.h"

#include <algorithm>

namespace arboc {
namespace {

constexpr bool kRequired = true;
constexpr bool kRepeats = true;

// clang-format off
constexpr AttributeSpec kName[] = {{"name"}};
constexpr AttributeSpec kRequiredName[] = {{"name", Value::kText, kRequired}};
constexpr AttributeSpec kOrigin[] = {{"xyz", Value::kVector3}, {"rpy", Value::kVector3}};
constexpr AttributeSpec kMass[] = {{"value", Value::kNumber, kRequired}};
constexpr AttributeSpec kInertia[] = {
    {"ixx", Value::kNumber, kRequired}, {"ixy", Value::kNumber, kRequired},
    {"ixz", Value::kNumber, kRequired}, {"iyy", Value::kNumber, kRequired},
    {"iyz", Value::kNumber, kRequired}, {"izz", Value::kNumber, kRequired}};
constexpr ElementSpec kInInertial[] = {
    {"origin", Tag::kOrigin, Use::kRead, false, kOrigin},
    {"mass", Tag::kMass, Use::kRead, false, kMass},
    {"inertia", Tag::kInertia, Use::kRead, false, kInertia}};

constexpr AttributeSpec kBox[] = {{"size", Value::kVector3, kRequired}};
constexpr AttributeSpec kSphere[] = {{"radius", Value::kNumber, kRequired}};
constexpr AttributeSpec kTube[] = {{"radius", Value::kNumber, kRequired},
                                   {"length", Value::kNumber, kRequired}};
constexpr AttributeSpec kMesh[] = {{"filename", Value::kText, kRequired},
                                   {"scale", Value::kVector3}};
constexpr ElementSpec kInGeometry[] = {
    {"box", Tag::kOther, Use::kChecked, false, kBox},
    {"sphere", Tag::kOther, Use::kChecked, false, kSphere},
    {"cylinder", Tag::kOther, Use::kChecked, false, kTube},
    {"capsule", Tag::kOther, Use::kChecked, false, kTube},
    {"mesh", Tag::kOther, Use::kChecked, false, kMesh}};
constexpr AttributeSpec kColor[] = {{"rgba", Value::kVector4, kRequired}};
constexpr AttributeSpec kTexture[] = {{"filename", Value::kText, kRequired}};
constexpr ElementSpec kInMaterial[] = {
    {"color", Tag::kOther, Use::kChecked, false, kColor},
    {"texture", Tag::kOther, Use::kChecked, false, kTexture}};
constexpr ElementSpec kInShape[] = {
    {"origin", Tag::kOther, Use::kChecked, false, kOrigin},
    {"geometry", Tag::kOther, Use::kChecked, false, {}, kInGeometry},
    {"material", Tag::kOther, Use::kChecked, false, kName, kInMaterial},
    {"verbose", Tag::kOther, Use::kSkipped},
    {"contact_coefficients", Tag::kOther, Use::kSkipped}};

constexpr AttributeSpec kLink[] = {{"name", Value::kText, kRequired}, {"type"}};
constexpr ElementSpec kInLink[] = {
    {"inertial", Tag::kInertial, Use::kRead, false, {}, kInInertial},
    {"visual", Tag::kOther, Use::kChecked, kRepeats, kName, kInShape},
    {"collision", Tag::kOther, Use::kChecked, kRepeats, kName, kInShape},
    {"collision_checking", Tag::kOther, Use::kSkipped, kRepeats},
    {"self_collision_checking", Tag::kOther, Use::kSkipped, kRepeats},
    {"contact", Tag::kOther, Use::kSkipped, kRepeats},
    {"sensor", Tag::kOther, Use::kSkipped, kRepeats},
    {"gazebo", Tag::kOther, Use::kSkipped, kRepeats}};

// That <parent> and <child> name a link is checked with the whole joint.
constexpr AttributeSpec kLinkReference[] = {{"link"}};
constexpr AttributeSpec kAxis[] = {{"xyz", Value::kVector3, kRequired}};
constexpr AttributeSpec kLimit[] = {
    {"lower", Value::kNumber}, {"upper", Value::kNumber},
    {"effort", Value::kNumber, kRequired}, {"velocity", Value::kNumber, kRequired}};
constexpr AttributeSpec kDynamics[] = {{"damping", Value::kNumber}, {"friction", Value::kNumber}};
constexpr AttributeSpec kMimic[] = {{"joint", Value::kText, kRequired},
                                    {"multiplier", Value::kNumber}, {"offset", Value::kNumber}};
constexpr AttributeSpec kCalibration[] = {{"rising", Value::kNumber}, {"falling", Value::kNumber},
                                          {"reference_position", Value::kNumber}};
constexpr AttributeSpec kSafety[] = {
    {"soft_lower_limit", Value::kNumber}, {"soft_upper_limit", Value::kNumber},
    {"k_position", Value::kNumber}, {"k_velocity", Value::kNumber, kRequired}};
constexpr AttributeSpec kJoint[] = {{"name", Value::kText, kRequired},
                                    {"type", Value::kText, kRequired}};
constexpr ElementSpec kInJoint[] = {
    {"origin", Tag::kOrigin, Use::kRead, false, kOrigin},
    {"parent", Tag::kParent, Use::kRead, false, kLinkReference},
    {"child", Tag::kChild, Use::kRead, false, kLinkReference},
    {"axis", Tag::kAxis, Use::kRead, false, kAxis},
    {"limit", Tag::kLimit, Use::kRead, false, kLimit},
    {"dynamics", Tag::kDynamics, Use::kRead, false, kDynamics},
    {"mimic", Tag::kMimic, Use::kRead, false, kMimic},
    {"calibration", Tag::kOther, Use::kChecked, false, kCalibration},
    {"safety_controller", Tag::kOther, Use::kChecked, false, kSafety}};

constexpr AttributeSpec kRobot[] = {{"name", Value::kText, kRequired}, {"version"}};
constexpr ElementSpec kInRobot[] = {
    {"link", Tag::kLink, Use::kRead, kRepeats, kLink, kInLink},
    {"joint", Tag::kJoint, Use::kRead, kRepeats, kJoint, kInJoint},
    {"material", Tag::kOther, Use::kChecked, kRepeats, kRequiredName, kInMaterial},
    {"transmission", Tag::kOther, Use::kSkipped, kRepeats},
    {"gazebo", Tag::kOther, Use::kSkipped, kRepeats},
    {"sensor", Tag::kOther, Use::kSkipped, kRepeats},
    {"ros2_control", Tag::kOther, Use::kSkipped, kRepeats},
    {"mujoco", Tag::kOther, Use::kSkipped, kRepeats},
    {"model_state", Tag::kOther, Use::kSkipped, kRepeats}};
constexpr ElementSpec kRobotElement = {"robot", Tag::kRobot, Use::kRead, false, kRobot, kInRobot};
// clang-format on

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Letters typed wrong, left out, added or swapped with their neighbour between `a` and `b`.
size_t typing_errors(std::string_view a, std::string_view b) {
  const size_t width = b.size() + 1;
  std::vector<size_t> d((a.size() + 1) * width);
  const auto cell = [&](size_t i, size_t j) -> size_t& { return d[i * width + j]; };
  for (size_t i = 0; i <= a.size(); ++i) {
    for (size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cell(i, j) = i + j;
        continue;
      }
      cell(i, j) = std::min({cell(i - 1, j) + 1, cell(i, j - 1) + 1,
                             cell(i - 1, j - 1) + (lower(a[i - 1]) != lower(b[j - 1]))});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cell(i, j) = std::min(cell(i, j), cell(i - 2, j - 2) + 1);
    }
  }
  return d.back();
}

}  // namespace

size_t numbers_in(Value value) {
  switch (value) {
    case Value::kText: return 0;
    case Value::kNumber: return 1;
    case Value::kVector3: return 3;
    case Value::kVector4: return 4;
  }
  return 0;
}

const ElementSpec& robot_schema() { return kRobotElement; }

const char* home_of(std::string_view name) {
  for (const ElementSpec* home : {&kInRobot[0], &kInRobot[1], &kInLink[0], &kRobotElement})
    for (const ElementSpec& child : home->children)
      if (child.name == name) return home->name;
  return nullptr;
}

bool equal_but_for_case(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                            [](char x, char y) { return lower(x) == lower(y); });
}

std::string nearest(std::string_view word, const std::vector<std::string_view>& known) {
  constexpr size_t kLongestWord = 64;
  if (word.size() > kLongestWord) return "";
  std::string best;
  size_t fewest = 3;
  for (const std::string_view candidate : known) {
    const size_t tolerated = candidate.size() <= 2 ? 0 : candidate.size() <= 5 ? 1 : 2;
    const size_t longer = std::max(word.size(), candidate.size());
    if (longer - std::min(word.size(), candidate.size()) > tolerated) continue;
    const size_t errors = typing_errors(word, candidate);
    if (errors <= tolerated && errors < fewest) {
      fewest = errors;
      best = candidate;
    }
  }
  return best;
}

}  // namespace arboc

#include "frontend/schema.h"

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

}  // namespace arboc

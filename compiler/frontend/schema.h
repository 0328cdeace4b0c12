// What URDF can say: elements, their attributes and what may stand in them, as tables.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace arboc {

/// The elements that carry what the model needs; all others are kOther.
enum class Tag {
  kRobot,
  kLink,
  kInertial,
  kMass,
  kInertia,
  kOrigin,
  kJoint,
  kParent,
  kChild,
  kAxis,
  kLimit,
  kDynamics,
  kMimic,
  kOther
};

enum class Value { kText, kNumber, kVector3, kVector4 };

/// How many numbers a value consists of; 0 for text.
size_t numbers_in(Value value);

struct AttributeSpec {
  const char* name;
  Value value = Value::kText;
  bool required = false;
};

/// What is done with an element.
enum class Use {
  kRead,     ///< faults are errors
  kChecked,  ///< without bearing on the dynamics: faults are warnings, counted as ignored
  kSkipped,  ///< other programs' extensions: nothing inside is looked at, counted as ignored
};

struct ElementSpec {
  const char* name;
  Tag tag = Tag::kOther;
  Use use = Use::kRead;
  bool repeats = false;  ///< may stand more than once in its parent
  std::span<const AttributeSpec> attributes{};
  std::span<const ElementSpec> children{};
};

/// The document element <robot>.
const ElementSpec& robot_schema();

/// The name of a read element in which one called `name` may stand, or nothing.
const char* home_of(std::string_view name);

}  // namespace arboc

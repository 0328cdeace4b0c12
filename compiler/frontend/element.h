// One URDF element after its attributes have been checked against the schema.
#pragma once
#include <array>
#include <string>
#include <string_view>

#include "frontend/schema.h"
#include "model/findings.h"
#include "model/model.h"

namespace arboc {

struct AttributeValue {
  bool present = false;
  bool valid = false;  ///< present, and as many numbers as it should be
  std::string_view text{};
  std::array<double, 4> number{};
  Location where{};

  Vector3<double> vector() const { return {number[0], number[1], number[2]}; }
};

struct Element {
  static constexpr size_t kMostAttributes = 6;

  const ElementSpec* spec = nullptr;
  Tag parent = Tag::kOther;
  Location where{};
  std::string owner{};  ///< "joint 'elbow'": the link or joint that it is part of
  std::string path{};   ///< "<inertial>: <mass>: ": the way to it from there
  std::array<AttributeValue, kMostAttributes> values{};

  /// The attribute called `name`, which the schema must have.
  const AttributeValue& operator[](std::string_view name) const {
    size_t i = 0;
    while (spec->attributes[i].name != name) ++i;
    return values[i];
  }

  Finding fault(Location place, std::string message, std::string hint = {}) const {
    return {place, owner, path + std::move(message), std::move(hint)};
  }
};

}  // namespace arboc

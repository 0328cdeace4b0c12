// Other coordinates for the same freedoms: chains of axes, and cosine with sine.
#include <fmt/format.h>

#include "model/configure_steps.h"
#include "model/findings.h"

namespace arboc {
namespace {

constexpr Vector3<double> kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

/// What the joint's motion is composed of; empty for joints that stay.
std::vector<JointAxis> chain_of_axes(const Joint& joint) {
  const std::vector<JointAxis> slides{{true, kX, "x"}, {true, kY, "y"}, {true, kZ, "z"}};
  std::vector<JointAxis> turns{{false, kZ, "rz"}, {false, kY, "ry"}, {false, kX, "rx"}};
  switch (joint.type) {
    case JointType::kPlanar: {
      const Matrix3<double> F = axis_frame(joint.axis);
      return {{true, column(F, 0), "x"}, {true, column(F, 1), "y"}, {false, joint.axis, "rz"}};
    }
    case JointType::kFloating: turns.insert(turns.begin(), slides.begin(), slides.end()); break;
    case JointType::kSpherical: break;
    default: turns.clear();
  }
  return turns;
}

void note(const Model& model, const Joint& joint, std::string message, Diagnostics& diagnostics) {
  diagnostics.report({Severity::kNote, model.file, joint.location, named("joint", joint.name),
                      std::move(message), ""});
}

}  // namespace

void expand_joints(Model& model, Diagnostics& diagnostics) {
  for (Joint& joint : model.joints) {
    std::vector<JointAxis> axes = chain_of_axes(joint);
    if (axes.empty()) continue;
    note(model, joint,
         fmt::format("{} joint taken as {} axes{}", name(joint.type), axes.size(),
                     joint.type == JointType::kPlanar
                         ? ""
                         : "; its rates are singular where the turn about y is 90 degrees"),
         diagnostics);
    joint.type = JointType::kMultiAxis;
    joint.axes = std::move(axes);
  }
}

void unbind_continuous_joints(Model& model, Diagnostics& diagnostics) {
  std::vector<char> leads(model.joints.size());
  for (const Joint& joint : model.joints)
    if (joint.mimic) leads[static_cast<size_t>(joint.mimic->leader)] = true;
  for (size_t k = 0; k < model.joints.size(); ++k) {
    Joint& joint = model.joints[k];
    if (joint.type != JointType::kContinuous) continue;
    if (joint.mimic || leads[k]) {
      note(model, joint, "keeps an angle for coordinate, because of <mimic>", diagnostics);
      continue;
    }
    joint.type = JointType::kUnbounded;
  }
}

}  // namespace arboc

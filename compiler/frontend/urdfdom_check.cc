#include "frontend/urdfdom_check.h"

#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "base/number.h"
#include "model/findings.h"
#include "model/validate.h"

namespace arboc {
namespace {

std::string text(const Vector3<double>& v) {
  return shortest(v.x) + " " + shortest(v.y) + " " + shortest(v.z);
}

std::string origin_text(const Pose& pose) {
  return fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", text(pose.xyz), text(pose.rpy));
}

bool has_bounds(JointType type) {
  return type == JointType::kRevolute || type == JointType::kPrismatic;
}

/// Not for fixed joints: urdfdom drops theirs.
bool has_dynamics(const Joint& joint) { return joint.damping != 0 || joint.friction != 0; }

void append_link(const Link& link, int index, std::string& out) {
  out += fmt::format("<link name=\"l{}\">", index);
  if (link.inertial) {
    const Symmetric3<double>& I = link.inertial->inertia;
    out += fmt::format(
        "<inertial>{}<mass value=\"{}\"/><inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" "
        "iyz=\"{}\" izz=\"{}\"/></inertial>",
        origin_text(link.inertial->origin), shortest(link.inertial->mass), shortest(I.xx),
        shortest(I.xy), shortest(I.xz), shortest(I.yy), shortest(I.yz), shortest(I.zz));
  }
  out += "</link>\n";
}

void append_joint(const Joint& joint, int index, std::string& out) {
  out +=
      fmt::format("<joint name=\"j{}\" type=\"{}\">{}<parent link=\"l{}\"/><child link=\"l{}\"/>",
                  index, name(joint.type), origin_text(joint.origin), joint.parent, joint.child);
  if (has_axis(joint.type)) out += fmt::format("<axis xyz=\"{}\"/>", text(joint.axis));
  if (has_bounds(joint.type))
    out += fmt::format("<limit lower=\"{}\" upper=\"{}\" effort=\"{}\" velocity=\"{}\"/>",
                       shortest(joint.limits.lower), shortest(joint.limits.upper),
                       shortest(joint.limits.effort), shortest(joint.limits.velocity));
  if (has_dynamics(joint))
    out += fmt::format("<dynamics damping=\"{}\" friction=\"{}\"/>", shortest(joint.damping),
                       shortest(joint.friction));
  if (joint.mimic)
    out +=
        fmt::format("<mimic joint=\"j{}\" multiplier=\"{}\" offset=\"{}\"/>", joint.mimic->leader,
                    shortest(joint.mimic->multiplier), shortest(joint.mimic->offset));
  out += "</joint>\n";
}

/// Links from the root outwards and the joints onto them: a tree by itself.
struct Part {
  std::vector<int> links, joints;
};

Part compared_part(const Model& model) {
  const std::vector<int> joint_of = joints_onto(model);
  Part part;
  for (const int link : outward(model, joint_of)) {
    if (part.links.size() == kComparedLinks) break;
    part.links.push_back(link);
    if (link != model.root) part.joints.push_back(joint_of[static_cast<size_t>(link)]);
  }
  return part;
}

std::string minimal_document(const Model& model, const Part& part) {
  std::string out = "<robot name=\"r\">\n";
  for (const int k : part.links) append_link(model.links[static_cast<size_t>(k)], k, out);
  for (const int k : part.joints) append_joint(model.joints[static_cast<size_t>(k)], k, out);
  return out + "</robot>\n";
}

int urdfdom_type(JointType type) {
  switch (type) {
    case JointType::kFixed: return urdf::Joint::FIXED;
    case JointType::kRevolute: return urdf::Joint::REVOLUTE;
    case JointType::kContinuous: return urdf::Joint::CONTINUOUS;
    case JointType::kPrismatic: return urdf::Joint::PRISMATIC;
    case JointType::kFloating: return urdf::Joint::FLOATING;
    case JointType::kPlanar: return urdf::Joint::PLANAR;
    default: return urdf::Joint::UNKNOWN;  // no URDF joint
  }
}

/// Compares the fields of one link or joint.
class Comparison {
 public:
  explicit Comparison(const std::string& element) : element_(element) {}

  void require(bool same, const char* field) const {
    if (!same)
      throw std::logic_error(fmt::format("urdfdom reads another {} of {}", field, element_));
  }
  void equal(double ours, double theirs, const char* field) const {
    require(ours == theirs, field);
  }
  void equal(const Vector3<double>& ours, const urdf::Vector3& theirs, const char* field) const {
    require(ours.x == theirs.x && ours.y == theirs.y && ours.z == theirs.z, field);
  }
  void equal(const Pose& ours, const urdf::Pose& theirs) const {
    equal(ours.xyz, theirs.position, "origin xyz");
    const Matrix3<double> R = rotation(ours);
    const double largest_angle =
        std::max({std::fabs(ours.rpy.x), std::fabs(ours.rpy.y), std::fabs(ours.rpy.z)});
    const double tolerance = 1e-14 + 8 * std::numeric_limits<double>::epsilon() * largest_angle;
    const urdf::Rotation& q = theirs.rotation;
    for (int j = 0; j < 3; ++j) {
      const urdf::Vector3 theirs_j = q * urdf::Vector3(j == 0, j == 1, j == 2);
      const Vector3<double> d = column(R, j) - Vector3<double>{theirs_j.x, theirs_j.y, theirs_j.z};
      require(std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}) <= tolerance,
              "origin rpy");
    }
  }

 private:
  std::string element_;
};

void compare(const Link& ours, const urdf::Link& theirs, const std::string& element) {
  const Comparison with(element);
  with.require(ours.inertial.has_value() == (theirs.inertial != nullptr), "inertial");
  if (!ours.inertial) return;
  const Symmetric3<double>& I = ours.inertial->inertia;
  with.equal(ours.inertial->mass, theirs.inertial->mass, "mass");
  with.equal({I.xx, I.xy, I.xz}, {theirs.inertial->ixx, theirs.inertial->ixy, theirs.inertial->ixz},
             "inertia");
  with.equal({I.yy, I.yz, I.zz}, {theirs.inertial->iyy, theirs.inertial->iyz, theirs.inertial->izz},
             "inertia");
  with.equal(ours.inertial->origin, theirs.inertial->origin);
}

void compare(const Joint& ours, const urdf::Joint& theirs, const std::string& element) {
  const Comparison with(element);
  with.require(urdfdom_type(ours.type) == theirs.type, "type");
  with.require(theirs.parent_link_name == fmt::format("l{}", ours.parent), "parent");
  with.require(theirs.child_link_name == fmt::format("l{}", ours.child), "child");
  with.equal(ours.origin, theirs.parent_to_joint_origin_transform);
  if (has_axis(ours.type)) with.equal(ours.axis, theirs.axis, "axis");
  with.require(has_bounds(ours.type) == (theirs.limits != nullptr), "limit");
  if (theirs.limits) {
    with.equal(ours.limits.lower, theirs.limits->lower, "lower limit");
    with.equal(ours.limits.upper, theirs.limits->upper, "upper limit");
    with.equal(ours.limits.effort, theirs.limits->effort, "effort limit");
    with.equal(ours.limits.velocity, theirs.limits->velocity, "velocity limit");
  }
  with.require(has_dynamics(ours) == (theirs.dynamics != nullptr), "dynamics");
  if (theirs.dynamics) {
    with.equal(ours.damping, theirs.dynamics->damping, "damping");
    with.equal(ours.friction, theirs.dynamics->friction, "friction");
  }
  with.require(ours.mimic.has_value() == (theirs.mimic != nullptr), "mimic");
  if (!ours.mimic) return;
  with.require(theirs.mimic->joint_name == fmt::format("j{}", ours.mimic->leader), "mimic leader");
  with.equal(ours.mimic->multiplier, theirs.mimic->multiplier, "mimic multiplier");
  with.equal(ours.mimic->offset, theirs.mimic->offset, "mimic offset");
}

}  // namespace

void compare_with_urdfdom(const Model& model) {
  const Part part = compared_part(model);
  const urdf::ModelInterfaceSharedPtr theirs = urdf::parseURDF(minimal_document(model, part));
  if (!theirs) throw std::logic_error("urdfdom refuses the model");
  const Comparison whole("the robot");
  whole.require(theirs->links_.size() == part.links.size(), "number of links");
  whole.require(theirs->joints_.size() == part.joints.size(), "number of joints");
  whole.require(theirs->root_link_ && theirs->root_link_->name == fmt::format("l{}", model.root),
                "root");
  for (const int k : part.links) {
    const Link& ours = model.links[static_cast<size_t>(k)];
    const auto link = theirs->getLink(fmt::format("l{}", k));
    whole.require(link != nullptr, "set of links");
    compare(ours, *link, named("link", ours.name));
  }
  for (const int k : part.joints) {
    const Joint& ours = model.joints[static_cast<size_t>(k)];
    const auto joint = theirs->getJoint(fmt::format("j{}", k));
    whole.require(joint != nullptr, "set of joints");
    compare(ours, *joint, named("joint", ours.name));
  }
}

}  // namespace arboc

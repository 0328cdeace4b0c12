#include "fuzz/robot.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace arboc::fuzz {
namespace {

constexpr const char* kPieces[] = {
    "a",      "b",  "link",     "é",      "机",     "\"",    "'", "\\",  "*/",      "//",   "??/",
    "%s%n",   "{}", "@name@",   "<",      ">",      "&",     " ", "-->", "]]>",     "int",  "class",
    "T",      "0",  "R\"(",     ")\"",    "#",      "$(rm)", "`", ";",   "../",     "NULL", "nan",
    "printf", "q",  "__LINE__", "\u202e", "\u2028", "main",  "_", "std", "\\u0041", "\\\n"};

std::string some_name(Bytes& bytes, const char* unique, size_t k) {
  std::string name;
  for (size_t pieces = bytes.below(4); pieces > 0; --pieces) name += bytes.pick(kPieces);
  std::erase(name, '\n');  // control characters are no names
  return name + unique + std::to_string(k);
}

/// Angles and lengths as people write them, and any.
double number(Bytes& bytes) {
  constexpr double kUsual[] = {0, 0, 0, 0.1, -0.25, 1, 1.5707963267948966, -1.57, 3.14159, 0.5235};
  return bytes.chance(180) ? bytes.pick(kUsual) : 2 * bytes.unit();
}

void choose_joint(Robot& robot, size_t k, Bytes& bytes) {
  constexpr const char* kTypes[] = {"revolute", "continuous", "prismatic",
                                    "fixed",    "planar",     "floating"};
  RobotJoint joint;
  joint.name = some_name(bytes, "j", k);
  joint.type = bytes.chance(200) ? kTypes[bytes.below(4)] : bytes.pick(kTypes);
  joint.parent = static_cast<int>(bytes.below(robot.links.size()));
  for (double& x : joint.xyz) x = number(bytes);
  for (double& x : joint.rpy) x = number(bytes);
  const size_t axis = bytes.below(4);
  for (size_t i = 0; i < 3; ++i)
    joint.axis[i] = axis < 3 ? (i == axis ? (bytes.chance(128) ? 1 : -1) : 0) : 0.1 + bytes.unit();
  const auto single = [](const std::string& t) {
    return t != "fixed" && t != "planar" && t != "floating";
  };
  if (k > 0 && single(joint.type) && bytes.chance(40)) {
    const size_t leader = bytes.below(k);
    if (single(robot.joints[leader].type)) {
      joint.leader = static_cast<int>(leader);
      joint.multiplier = 0.5 + bytes.unit() / 4;
      joint.offset = bytes.unit();
    }
  }
  robot.joints.push_back(joint);
  robot.links.push_back(some_name(bytes, "l", k + 1));
  robot.mass.push_back(bytes.chance(220) ? 0.5 + bytes.next() / 64.0 : 0);
}

/// Writes tags; every choice that means nothing comes from the bytes.
class Writer {
 public:
  explicit Writer(Bytes& bytes) : bytes_(bytes) {}

  using Attributes = std::vector<std::pair<std::string, std::string>>;

  void open(const std::string& tag, Attributes attributes) {
    start(tag, std::move(attributes), ">");
  }
  void close(const std::string& tag) {
    out_ += "</" + tag + (bytes_.chance(30) ? " >" : ">"), space();
  }
  void empty(const std::string& tag, Attributes attributes) {
    if (bytes_.chance(60)) {
      open(tag, std::move(attributes));
      close(tag);
    } else {
      start(tag, std::move(attributes), "/>");
    }
  }
  std::string take() { return std::move(out_); }

  static std::string text(const double (&x)[3]) {
    return fmt::format("{} {} {}", x[0], x[1], x[2]);
  }

 private:
  void start(const std::string& tag, Attributes attributes, const char* end) {
    if (attributes.size() > 1 && bytes_.chance(60))
      std::reverse(attributes.begin(), attributes.end());
    out_ += "<" + tag;
    for (const auto& [name, value] : attributes) {
      const char quote = bytes_.chance(60) ? '\'' : '"';
      out_ += (bytes_.chance(20) ? "\n\t" : " ") + name + "=" + quote + escaped(value) + quote;
    }
    out_ += end;
    space();
  }

  std::string escaped(const std::string& value) {
    std::string out;
    for (const char c : value) {
      switch (c) {
        case '<': out += "&lt;"; break;
        case '&': out += "&#38;"; break;
        case '"': out += "&quot;"; break;
        case '\'': out += "&#x27;"; break;
        default: out += c;
      }
    }
    return out;
  }

  void space() {
    constexpr const char* kSpaces[] = {
        "\n", "", " ", "\r\n", "<!-- <link name='x'/> & -->", "\t", "<?pi x='>'?>"};
    out_ += bytes_.pick(kSpaces);
  }

  Bytes& bytes_;
  std::string out_;
};

void write_link(const Robot& robot, size_t k, Writer& out) {
  out.open("link", {{"name", robot.links[k]}});
  if (robot.mass[k] > 0) {
    const std::string I = fmt::format("{}", 0.02 * robot.mass[k]);
    out.open("inertial", {});
    out.empty("origin", {{"xyz", "0 0.05 -0.1"}, {"rpy", "0 0 0"}});
    out.empty("mass", {{"value", fmt::format("{}", robot.mass[k])}});
    out.empty("inertia",
              {{"ixx", I}, {"ixy", "0"}, {"ixz", "0"}, {"iyy", I}, {"iyz", "0"}, {"izz", I}});
    out.close("inertial");
  }
  out.close("link");
}

void write_joint(const Robot& robot, size_t k, Writer& out) {
  const RobotJoint& joint = robot.joints[k];
  out.open("joint", {{"name", joint.name}, {"type", joint.type}});
  out.empty("parent", {{"link", robot.links[static_cast<size_t>(joint.parent)]}});
  out.empty("child", {{"link", robot.links[k + 1]}});
  out.empty("origin", {{"xyz", Writer::text(joint.xyz)}, {"rpy", Writer::text(joint.rpy)}});
  if (joint.type != "fixed" && joint.type != "floating")
    out.empty("axis", {{"xyz", Writer::text(joint.axis)}});
  if (joint.type == "revolute" || joint.type == "prismatic")
    out.empty("limit", {{"lower", "-1"}, {"upper", "1"}, {"effort", "10"}, {"velocity", "1"}});
  if (joint.leader >= 0)
    out.empty("mimic", {{"joint", robot.joints[static_cast<size_t>(joint.leader)].name},
                        {"multiplier", fmt::format("{}", joint.multiplier)},
                        {"offset", fmt::format("{}", joint.offset)}});
  out.close("joint");
}

}  // namespace

Robot robot_of(Bytes& bytes) {
  Robot robot;
  robot.name = some_name(bytes, bytes.chance(128) ? "" : "r", 0);
  robot.links.push_back(some_name(bytes, "l", 0));
  robot.mass.push_back(1);
  for (size_t k = 0, joints = 1 + bytes.below(6); k < joints; ++k) choose_joint(robot, k, bytes);
  return robot;
}

std::string urdf_of(const Robot& robot, Bytes& bytes) {
  Writer out(bytes);
  out.open("robot", {{"name", robot.name}});
  // Links first, or each with its joint; the depth-first order of what results is the same.
  const bool together = bytes.chance(128);
  write_link(robot, 0, out);
  for (size_t k = 0; k < robot.joints.size(); ++k) {
    write_link(robot, k + 1, out);
    if (together) write_joint(robot, k, out);
  }
  for (size_t k = 0; !together && k < robot.joints.size(); ++k) write_joint(robot, k, out);
  out.close("robot");
  return out.take();
}

}  // namespace arboc::fuzz

// [joints] and [root]: what moves the rows, and the body as a whole.
#include <fmt/format.h>

#include <algorithm>

#include "base/number.h"
#include "base/words.h"
#include "frontend/dh_file.h"

namespace arboc {
namespace {

/// Different letters among X, Y and Z.
bool are_axes(const std::string& axes, size_t fewest) {
  if (axes.size() < fewest || axes.size() > 3) return false;
  for (size_t i = 0; i < axes.size(); ++i)
    if (axes[i] < 'X' || axes[i] > 'Z' || axes.find(axes[i]) != i) return false;
  return true;
}

char lower(char c) { return static_cast<char>(c - 'A' + 'a'); }

class JointReader {
 public:
  JointReader(DhTable& table, DhJoint& joint, const DhUnits& units)
      : table_(table), joint_(joint), units_(units) {}

  void read() {
    table_.find("axes");
    table_.find("names");
    table_.find("note");
    limits();
    torques();
    const auto positive = [&](const char* key, double DhDrive::*field) {
      each(key, field);
      for (const DhDrive& drive : joint_.drives)
        if (drive.*field < 0) {
          table_.error(key, "is negative");
          break;
        }
    };
    each("velocity", nullptr);
    each("stiffness", &DhDrive::stiffness);
    positive("damping", &DhDrive::damping);
    positive("friction", &DhDrive::friction);
    each("neutral", &DhDrive::neutral);
    for (DhDrive& drive : joint_.drives) drive.neutral = coordinate(drive.neutral);
    positive("rotor", &DhDrive::rotor);
    if (const auto gear = table_.number("gear")) {
      if (*gear == 0) table_.error("gear", "is 0");
      if (!table_.has("rotor")) table_.error("gear", "there is no rotor for it");
      for (DhDrive& drive : joint_.drives) drive.rotor *= *gear * *gear;
    }
    table_.unknown_keys();
  }

 private:
  double coordinate(double written) const {
    return joint_.slides ? written / units_.length : units_.angle(written);
  }

  /// The pairs of a key: one for all axes, or one an axis.
  std::vector<std::pair<double, double>> pairs(const char* key) {
    const DhValue* value = table_.find(key);
    if (value == nullptr) return {};
    const bool nested = value->kind == DhValue::Kind::kList && !value->items.empty() &&
                        value->items[0].kind == DhValue::Kind::kList;
    std::vector<std::pair<double, double>> result;
    const auto read_pair = [&](const DhValue& item) {
      if (item.kind != DhValue::Kind::kList || item.items.size() != 2) return false;
      const std::string about = std::string(key) + ": ";
      const auto lower = finite_number(item.items[0], table_.element(), about, table_.report());
      const auto upper = finite_number(item.items[1], table_.element(), about, table_.report());
      result.emplace_back(lower.value_or(0), upper.value_or(0));
      return true;
    };
    bool good = true;
    if (nested)
      for (const DhValue& item : value->items) good = good && read_pair(item);
    else
      good = read_pair(*value);
    if (good && nested && result.size() != joint_.drives.size()) good = false;
    if (!good) {
      table_.error(key, joint_.drives.size() == 1
                            ? "is not [lower, upper]"
                            : fmt::format("is neither [lower, upper] nor a list of {} of these",
                                          joint_.drives.size()));
      return {};
    }
    result.resize(joint_.drives.size(), result.back());
    return result;
  }

  void limits() {
    const auto given = pairs("limits");
    for (size_t k = 0; k < given.size(); ++k) {
      joint_.drives[k].limits.lower = coordinate(given[k].first);
      joint_.drives[k].limits.upper = coordinate(given[k].second);
    }
  }

  void torques() {
    if (const DhValue* value = table_.find("torque");
        value != nullptr && value->kind == DhValue::Kind::kNumber) {
      const auto x = table_.number("torque");
      for (DhDrive& drive : joint_.drives) {
        drive.limits.effort = x.value_or(0);
        drive.limits.effort_lower = -drive.limits.effort;
      }
      if (x.value_or(0) < 0) table_.error("torque", "is negative", "write [lower, upper]");
      return;
    }
    const auto given = pairs("torque");
    for (size_t k = 0; k < given.size(); ++k) {
      joint_.drives[k].limits.effort_lower = given[k].first;
      joint_.drives[k].limits.effort = given[k].second;
      if (given[k].first > 0 || given[k].second < 0)
        table_.error("torque", "does not contain 0", "[lower, upper], as in [-80, 80]");
    }
  }

  /// One number for all axes, or one an axis; no field: the velocity limit.
  void each(const char* key, double DhDrive::*field) {
    const DhValue* value = table_.find(key);
    if (value == nullptr) return;
    std::vector<double> given(joint_.drives.size());
    if (value->kind == DhValue::Kind::kList) {
      const auto list = table_.numbers(key, joint_.drives.size());
      if (!list) return;
      given = *list;
    } else {
      std::fill(given.begin(), given.end(), table_.number(key).value_or(0));
    }
    for (size_t k = 0; k < given.size(); ++k) {
      if (field != nullptr) {
        joint_.drives[k].*field = given[k];
      } else {
        joint_.drives[k].limits.velocity = coordinate(given[k]);
        if (given[k] < 0) table_.error(key, "is negative", "limits are magnitudes");
      }
    }
  }

  DhTable& table_;
  DhJoint& joint_;
  const DhUnits& units_;
};

void read_names(DhTable& table, DhJoint& joint) {
  if (const auto axes = table.text("axes")) {
    joint.axes = *axes;
    if (!are_axes(joint.axes, 1)) {
      table.error("axes", quoted(joint.axes) + " are not orthogonal axes",
                  "one to three different ones of X, Y and Z, in their order: \"ZY\"");
      joint.axes = "Z";
    }
  }
  joint.drives.resize(std::max<size_t>(joint.axes.size(), 1));
  for (const char axis : joint.axes)
    joint.names.push_back(joint.axes.size() == 1 ? joint.name
                                                 : fmt::format("{}.{}", joint.name, lower(axis)));
  const auto names = table.texts("names");
  if (!names) return;
  if (joint.axes.size() < 2 || names->size() != joint.axes.size())
    table.error("names", "names the axes of a joint with several, each");
  else
    joint.names = *names;
}

}  // namespace

void read_joint_names(const DhValue& joints, const DhReport& report, DhFile& file) {
  DhTable table(joints, "joints", report);
  if (!table.is_table()) return;
  for (const DhValue::Entry& entry : joints.entries) {
    DhTable one(entry.value, named("joint", entry.key), report);
    DhJoint joint;
    joint.name = entry.key;
    joint.where = entry.where;
    if (one.is_table()) read_names(one, joint);
    joint.drives.resize(std::max<size_t>(joint.axes.size(), 1));
    if (joint.axes.empty() && !is_identifier(joint.name))
      report.error(entry.where, one.element(), "the name cannot stand in a cell",
                   "names are letters, digits and '_'");
    const bool is_new = file.symbols
                            .try_emplace(joint.name, DhSymbol{DhSymbol::Kind::kJoint,
                                                              static_cast<int>(file.joints.size())})
                            .second;
    if (!is_new) report.error(entry.where, one.element(), "a length has this name");
    file.joints.push_back(std::move(joint));
  }
}

void read_joints(const DhValue& joints, const DhReport& report, DhFile& file) {
  if (joints.kind != DhValue::Kind::kTable) return;
  for (size_t k = 0; k < joints.entries.size(); ++k) {
    const DhValue& value = joints.entries[k].value;
    if (value.kind != DhValue::Kind::kTable) continue;
    DhTable table(value, named("joint", file.joints[k].name), report);
    JointReader(table, file.joints[k], file.units).read();
  }
}

void read_postures(const DhValue& postures, const DhReport& report, DhFile& file) {
  struct Coordinate {
    std::string name;
    bool slides;
    Limits limits;
  };
  std::vector<Coordinate> all;
  std::vector<std::string_view> names;
  if (file.root.is_free && !file.root.quaternion)
    for (size_t k = 0; k < file.root.names.size(); ++k)
      all.push_back({file.root.names[k], k < file.root.translations.size(), {}});
  for (const DhJoint& joint : file.joints)
    for (size_t k = 0; k < joint.drives.size(); ++k)
      all.push_back({joint.names.empty() ? joint.name : joint.names[k], joint.slides,
                     joint.drives[k].limits});
  for (const Coordinate& c : all) names.emplace_back(c.name);
  DhTable table(postures, "postures", report);
  if (!table.is_table()) return;
  for (const DhValue::Entry& entry : postures.entries) {
    const std::string element = fmt::format("posture {}", quoted(entry.key));
    DhTable one(entry.value, element, report);
    DhPosture posture{entry.key, entry.where, {}};
    for (const DhValue::Entry& place : entry.value.entries) {
      const auto c = std::find_if(all.begin(), all.end(),
                                  [&](const Coordinate& x) { return x.name == place.key; });
      const auto x = finite_number(place.value, element, place.key + ": ", report);
      if (c == all.end()) {
        const std::string meant = nearest(place.key, names);
        report.error(place.where, element, fmt::format("there is no joint {}", quoted(place.key)),
                     meant.empty() ? "" : fmt::format("did you mean {}?", quoted(meant)));
      } else if (x) {
        const double q = c->slides ? *x / file.units.length : file.units.angle(*x);
        posture.q.emplace_back(c->name, q);
        if (q < c->limits.lower || q > c->limits.upper)
          report.warning(
              place.where, element,
              fmt::format("{}: {} is outside the limits [{}, {}]", place.key, shortest(q),
                          shortest(c->limits.lower), shortest(c->limits.upper)));
      }
    }
    file.postures.push_back(std::move(posture));
  }
}

void read_root(const DhValue& value, const DhReport& report, DhFile& file) {
  DhTable table(value, "root", report);
  if (!table.is_table()) return;
  DhRoot& root = file.root;
  root.where = value.where;
  if (const auto frame = table.text("frame")) root.frame = *frame;
  root.is_free = table.flag("free").value_or(false);
  root.quaternion = table.flag("quaternion").value_or(false);
  bool some = false;
  for (const auto& [key, order] :
       {std::pair{"translations", &root.translations}, std::pair{"rotations", &root.rotations}}) {
    const auto given = table.text(key);
    if (!given) continue;
    if (!root.is_free) table.error(key, "the root is not free", "write free = true");
    some = true;
    if (are_axes(*given, 1))
      *order = *given;
    else
      table.error(key, quoted(*given) + " are not different axes in some order", "as in \"ZXY\"");
  }
  // Who names translations only does not want turns, and the other way round.
  if (some && !table.has("translations")) root.translations.clear();
  if (some && !table.has("rotations")) root.rotations.clear();
  for (const char axis : root.translations) root.names.push_back(fmt::format("t{}", lower(axis)));
  for (const char axis : root.rotations) root.names.push_back(fmt::format("r{}", lower(axis)));
  if (const auto names = table.texts("names")) {
    if (names->size() == root.names.size())
      root.names = *names;
    else
      table.error("names", fmt::format("the root has {} coordinates", root.names.size()));
  }
  if (root.quaternion && !root.is_free)
    table.error("quaternion", "the root is not free", "write free = true");
  if (root.quaternion && some)
    table.error("quaternion", "a quaternion is free in all directions, without an order");
  read_xyz(table, "xyz", file.units, file, root.xyz);
  root.turn = read_turn(table, file.units);
  if (table.has("mass") || table.has("cg") || table.has("inertia")) {
    root.mass.emplace();
    root.mass->where = value.where;
    read_mass(table, file.units, file, *root.mass);
  }
  for (const char* key : {"mass", "cg", "inertia", "inertia_about"}) table.find(key);
  table.unknown_keys();
}

}  // namespace arboc

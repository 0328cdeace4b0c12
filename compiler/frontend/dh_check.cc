// What rows and joints together get wrong, and where rows stand at zero.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/exact_trig.h"
#include "base/number.h"
#include "frontend/dh_file.h"

namespace arboc {
namespace {

size_t at(int k) { return static_cast<size_t>(k); }

std::string text(double lower, double upper) {
  return fmt::format("[{}, {}]", shortest(lower), shortest(upper));
}

/// Lower limits beyond upper ones: one by one, or that the columns are swapped if all are; then
/// the other checks go on with swapped ones.
void check_limits(DhFile& file, const DhReport& report) {
  int limited = 0, reversed = 0;
  const DhJoint* first = nullptr;
  for (const DhJoint& joint : file.joints)
    for (const DhDrive& drive : joint.drives) {
      if (std::isinf(drive.limits.lower)) continue;
      ++limited;
      if (drive.limits.lower <= drive.limits.upper) continue;
      ++reversed;
      if (first == nullptr) first = &joint;
    }
  if (reversed == limited && reversed > 2) {
    report.error(first->where, "joints",
                 fmt::format("each of {} lower limits is greater than its upper one", reversed),
                 "the columns are swapped: [lower, upper]");
    for (DhJoint& joint : file.joints)
      for (DhDrive& drive : joint.drives)
        if (drive.limits.lower > drive.limits.upper)
          std::swap(drive.limits.lower, drive.limits.upper);
    return;
  }
  for (const DhJoint& joint : file.joints)
    for (const DhDrive& drive : joint.drives)
      if (drive.limits.lower > drive.limits.upper)
        report.error(joint.where, named("joint", joint.name),
                     fmt::format("limits: lower ({}) is greater than upper ({})",
                                 shortest(drive.limits.lower), shortest(drive.limits.upper)));
}

void check_neutral(const DhFile& file, const DhReport& report) {
  for (const DhJoint& joint : file.joints)
    for (size_t k = 0; k < joint.drives.size(); ++k) {
      const DhDrive& drive = joint.drives[k];
      if (drive.limits.lower <= drive.neutral && drive.neutral <= drive.limits.upper) continue;
      if (drive.stiffness == 0 && drive.neutral == 0) continue;  // nothing is said of it
      if (drive.limits.lower > drive.limits.upper) continue;
      const std::string name = joint.names.empty() ? joint.name : joint.names[k];
      report.warning(joint.where, named("joint", name),
                     fmt::format("neutral {} is outside the limits {}", shortest(drive.neutral),
                                 text(drive.limits.lower, drive.limits.upper)),
                     "its spring always pushes against a limit");
    }
}

/// The first row that a joint drives says which way it turns, the others by how much.
void check_factors(const DhFile& file, const DhReport& report) {
  std::vector<bool> led(file.joints.size());
  for (const DhRow& row : file.rows) {
    const DhCell& cell = row.theta.joint >= 0 ? row.theta : row.d;
    if (cell.joint < 0) continue;
    if (!led[at(cell.joint)] && std::fabs(cell.factor) != 1)
      report.error(row.where, named("row", row.name),
                   fmt::format("{} times {}", shortest(cell.factor),
                               named("joint", file.joints[at(cell.joint)].name)),
                   "the first row of a joint has it once, or minus it; multiples may follow");
    led[at(cell.joint)] = true;
  }
}

void check_unused(const DhFile& file, const DhReport& report) {
  for (const DhJoint& joint : file.joints)
    if (joint.uses == 0)
      report.warning(joint.where, named("joint", joint.name), "no row names it", "it is left out");
  for (const DhLength& length : file.lengths)
    if (!length.used)
      report.findings.warning({length.where, fmt::format("length '{}'", length.name),
                               "nothing is written in terms of it", "", length.file});
}

DhPlace after(const DhPlace& from, const Matrix3<double>& R, const Vector3<double>& p) {
  return {from.R * R, from.p + from.R * p, {}};
}

Matrix3<double> turned(const Vector3<double>& rpy, const Matrix3<double>& turn) {
  Pose pose;
  pose.rpy = rpy;
  pose.turn = turn;
  return rotation(pose);
}

DhPlace place(const DhRow& row, const DhPlace& parent, const DhFile& file) {
  const Matrix3<double> one = Matrix3<double>::identity();
  if (row.is_placed) {
    const DhPlace own = after(parent, turned(row.turn.rpy, row.turn.turn), value_of(row.xyz, file));
    return row.joint < 0 ? own
                         : after(own, local_frames(file.joints[at(row.joint)].axes).back(), {});
  }
  const DhPlace a{turned({row.alpha.constant, 0, 0}, one), {value_of(row.a, file), 0, 0}, {}};
  const DhPlace d{
      turned({0, 0, row.theta.value.constant}, one), {0, 0, value_of(row.d.value, file)}, {}};
  const Vector3<double> x = a.p;
  DhPlace own;
  if (file.modified) {
    const DhPlace hinge = after(after(parent, one, x), a.R, {});
    own = after(hinge, d.R, d.p);
    own.axis = column(hinge.R, 2);
  } else {
    own = after(after(after(parent, d.R, d.p), one, x), a.R, {});
    own.axis = column(parent.R, 2);
  }
  if (row.theta.joint < 0 && row.d.joint < 0) own.axis = {};
  if (row.joint >= 0) {
    const auto local = local_frames(file.joints[at(row.joint)].axes);
    const Vector3<double> none{};
    own = after(own, transpose(local.front()) * local.back(), none);
  }
  return own;
}

/// Of any frame whose row has been placed.
DhPlace frame_place(int frame, const DhPlace& base, const std::vector<DhPlace>& places,
                    const DhFile& file) {
  if (frame < 0) return base;
  if (frame < kPrivateFrame) return places[at(frame)];
  const int row = frame - kPrivateFrame;
  const auto local = local_frames(file.joints[at(file.rows[at(row)].joint)].axes);
  return after(places[at(row)], transpose(local.back()), {});
}

}  // namespace

double value_of(const DhLinear& x, const DhFile& file) {
  double value = x.constant;
  for (const auto& [symbol, factor] : x.terms)
    if (symbol.kind == DhSymbol::Kind::kLength)
      value += factor * file.lengths[at(symbol.index)].value;
  return value;
}

Vector3<double> value_of(const DhVector& xyz, const DhFile& file) {
  return {value_of(xyz[0], file), value_of(xyz[1], file), value_of(xyz[2], file)};
}

std::vector<DhPlace> zero_posture(const DhFile& file) {
  const DhPlace base =
      after({}, turned(file.root.turn.rpy, file.root.turn.turn), value_of(file.root.xyz, file));
  std::vector<DhPlace> places;
  for (const DhRow& row : file.rows)
    places.push_back(place(row, frame_place(row.parent, base, places, file), file));
  return places;
}

void check_branches(const Model& model, const DhReport& report) {
  constexpr int kMost = 3;
  std::vector<int> body(model.links.size()), branches(model.links.size());
  for (size_t k = 0; k < body.size(); ++k) body[k] = static_cast<int>(k);
  for (const Joint& joint : model.joints) {  // parents come before children
    if (joint.parent < 0) continue;
    if (joint.type == JointType::kFixed)
      body[at(joint.child)] = body[at(joint.parent)];
    else
      ++branches[at(body[at(joint.parent)])];
  }
  for (size_t k = 0; k < branches.size(); ++k)
    if (branches[k] > kMost)
      report.warning(model.links[k].location, named("link", model.links[k].name),
                     fmt::format("has {} branch joints", branches[k]),
                     "people's links have up to 3");
}

void check_dh(DhFile file, const DhReport& report) {
  check_limits(file, report);
  check_neutral(file, report);
  check_factors(file, report);
  check_unused(file, report);
  check_segments(file, report);
  check_mirrors(file, report);
}

}  // namespace arboc

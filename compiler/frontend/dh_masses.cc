// [segments], [points] and [mirror]: what hangs on the frames.
#include <fmt/format.h>

#include "base/words.h"
#include "frontend/dh_file.h"

namespace arboc {

void read_mass(DhTable& table, const DhUnits& units, DhFile& file, DhMass& mass) {
  if (const auto m = table.number("mass")) {
    mass.mass = *m / units.mass;
    mass.has_mass = true;
  }
  if (table.has("cg")) {
    read_xyz(table, "cg", units, file, mass.cg);
    mass.has_cg = true;
  }
  if (const auto about = table.word("inertia_about", {"cg", "origin"}))
    mass.at_origin = *about == 1;
  const DhValue* value = table.find("inertia");
  if (value == nullptr) return;
  const bool six = value->kind == DhValue::Kind::kList && value->items.size() == 6;
  const auto I = table.numbers("inertia", six ? 6 : 3);
  if (!I) return;
  mass.has_inertia = true;
  mass.products = six;
  mass.inertia = {};
  double* const entries[] = {&mass.inertia.xx, &mass.inertia.yy, &mass.inertia.zz,
                             &mass.inertia.xy, &mass.inertia.xz, &mass.inertia.yz};
  for (size_t k = 0; k < I->size(); ++k) *entries[k] = (*I)[k] / units.inertia;
}

void read_segments(const DhValue& segments, const DhReport& report, DhFile& file) {
  DhTable table(segments, "segments", report);
  if (!table.is_table()) return;
  for (const DhValue::Entry& entry : segments.entries) {
    DhTable one(entry.value, named("segment", entry.key), report);
    if (!one.is_table()) continue;
    DhSegment segment;
    segment.name = entry.key;
    segment.where = entry.where;
    segment.mass.where = entry.where;
    if (const auto frame = one.text("frame"))
      segment.row = row_called(*frame, one.where("frame"), one.element(), report, file);
    else if (!one.has("frame"))
      report.error(entry.where, one.element(), "frame is missing", "the frame that carries it");
    one.find("note");
    read_mass(one, file.units, file, segment.mass);
    segment.mass.axes = read_turn(one, file.units);
    one.unknown_keys();
    file.segments.push_back(std::move(segment));
  }
}

void read_points(const DhValue& points, const DhReport& report, DhFile& file) {
  DhTable table(points, "points", report);
  if (!table.is_table()) return;
  for (const DhValue::Entry& entry : points.entries) {
    DhTable one(entry.value, named("point", entry.key), report);
    if (!one.is_table()) continue;
    DhPoint point;
    point.name = entry.key;
    point.where = entry.where;
    if (const auto frame = one.text("frame"))
      point.row = row_called(*frame, one.where("frame"), one.element(), report, file);
    else if (!one.has("frame"))
      report.error(entry.where, one.element(), "frame is missing", "the frame that carries it");
    one.find("note");
    read_xyz(one, "xyz", file.units, file, point.xyz);
    point.turn = read_turn(one, file.units);
    one.unknown_keys();
    file.points.push_back(std::move(point));
  }
}

void read_mirrors(const DhValue& mirrors, const DhReport& report, DhFile& file) {
  if (mirrors.kind != DhValue::Kind::kList) {
    report.error(mirrors.where, "mirror", "is not a list", "write [[mirror]]");
    return;
  }
  for (const DhValue& value : mirrors.items) {
    DhTable table(value, "mirror", report);
    if (!table.is_table()) continue;
    DhMirror mirror;
    mirror.where = value.where;
    const auto normal = table.word("normal", {"x", "y", "z"});
    if (!table.has("normal"))
      report.error(value.where, "mirror", "normal is missing",
                   "the axis of the world that the plane of symmetry is normal to: \"x\"");
    mirror.normal = {};
    mirror.normal[static_cast<int>(normal.value_or(1))] = 1;
    for (const auto& [key, rows] :
         {std::pair{"left", &mirror.left}, std::pair{"right", &mirror.right}}) {
      const auto names = table.texts(key);
      if (!names) continue;
      for (const std::string& name : *names) {
        const int row = row_called(name, table.where(key), "mirror", report, file);
        if (row >= 0 && row < kPrivateFrame) rows->push_back(row);
      }
    }
    if (mirror.left.empty() || mirror.left.size() != mirror.right.size())
      report.error(value.where, "mirror", "left and right are not lists of equal length");
    table.unknown_keys();
    file.mirrors.push_back(std::move(mirror));
  }
}

}  // namespace arboc

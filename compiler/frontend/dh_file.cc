// Head and body of a DH file: the sections in their order, units, lengths, cells.
#include "frontend/dh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words.h"

namespace arboc {
namespace {

constexpr size_t kMaxNameBytes = 1024;

struct Unit {
  std::string_view name;
  double per_si;
};

double read_unit(DhTable& table, const char* key, const std::vector<Unit>& known, bool required) {
  std::vector<std::string_view> words;
  std::string list;
  for (const Unit& unit : known) {
    words.push_back(unit.name);
    list += (list.empty() ? "" : ", ") + std::string(unit.name);
  }
  if (!table.has(key) && required)
    table.report().error(table.where(), table.element(), fmt::format("{} is missing", key),
                         "state the unit: " + list);
  const auto k = table.word(key, words);
  return k ? known[*k].per_si : 1;
}

DhUnits read_units(DhTable& top) {
  const DhValue* value = top.find("units");
  DhUnits units;
  if (value == nullptr) {
    top.report().error(top.where(), "", "[units] is missing",
                       "state them: units = { length = \"m\", angle = \"rad\" }");
    return units;
  }
  DhTable table(*value, "units", top.report());
  if (!table.is_table()) return units;
  units.length = read_unit(table, "length", {{"m", 1}, {"cm", 100}, {"mm", 1000}}, true);
  units.degrees =
      read_unit(table, "angle", {{"rad", 0}, {"deg", 1}}, true) == 1 && table.has("angle");
  units.mass = read_unit(table, "mass", {{"kg", 1}, {"g", 1000}}, false);
  units.inertia = read_unit(
      table, "inertia",
      {{"kg m^2", 1}, {"kg cm^2", 1e4}, {"kg mm^2", 1e6}, {"g cm^2", 1e7}, {"g mm^2", 1e9}}, false);
  table.unknown_keys();
  return units;
}

void read_lengths(const DhValue& value, const DhUnits& units, const DhReport& report,
                  bool may_define, DhFile& file) {
  DhTable table(value, "lengths", report);
  if (!table.is_table()) return;
  for (const DhValue::Entry& entry : value.entries) {
    const std::string element = fmt::format("length {}", quoted(entry.key));
    const auto number = finite_number(entry.value, element, "", report);
    if (!is_identifier(entry.key))
      report.error(entry.where, element, "the name cannot stand in a cell",
                   "names are letters, digits and '_'");
    const auto known = std::find_if(file.lengths.begin(), file.lengths.end(),
                                    [&](const DhLength& l) { return l.name == entry.key; });
    if (known != file.lengths.end()) {
      if (number) known->value = *number / units.length;
      continue;
    }
    if (may_define) {
      file.symbols[entry.key] = {DhSymbol::Kind::kLength, static_cast<int>(file.lengths.size())};
      file.lengths.push_back(
          {entry.key, number.value_or(0) / units.length, entry.where, report.file});
      continue;
    }
    std::vector<std::string_view> names;
    for (const DhLength& l : file.lengths) names.push_back(l.name);
    const std::string meant = nearest(entry.key, names);
    report.error(entry.where, element, "the model has no such length",
                 meant.empty() ? "" : fmt::format("did you mean {}?", quoted(meant)));
  }
}

/// Reports names that stand twice among frames, segments and points, which share one name space.
void check_names(const DhReport& report, const DhFile& file) {
  struct Named {
    const std::string* name;
    Location where;
    const char* kind;
  };
  std::vector<Named> all{{&file.root.frame, file.root.where, "root"}};
  for (const DhRow& row : file.rows) all.push_back({&row.name, row.where, "row"});
  for (const DhSegment& s : file.segments) all.push_back({&s.name, s.where, "segment"});
  for (const DhPoint& p : file.points) all.push_back({&p.name, p.where, "point"});
  std::stable_sort(all.begin(), all.end(),
                   [](const Named& a, const Named& b) { return *a.name < *b.name; });
  for (size_t k = 1; k < all.size(); ++k)
    if (*all[k].name == *all[k - 1].name)
      report.error(all[k].where, named(all[k].kind, *all[k].name),
                   fmt::format("another {} has this name", all[k - 1].kind),
                   all[k - 1].where.line > 0 ? fmt::format("in line {}", all[k - 1].where.line)
                                             : "choose another one");
  for (const Named& n : all) {
    if (n.name->size() > kMaxNameBytes)
      report.error(n.where, n.kind, fmt::format("name has {} bytes", n.name->size()),
                   fmt::format("the limit is {}", kMaxNameBytes));
    for (const char c : *n.name)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
        report.error(n.where, named(n.kind, *n.name), "name contains a control character",
                     "a name is one line of text");
        break;
      }
  }
}

}  // namespace

DhFile read_head(const DhValue& document, const DhReport& report) {
  DhFile file;
  DhTable top(document, "", report);
  const auto name = top.text("name");
  if (!top.has("name")) report.error({1, 1}, "", "name is missing", "write name = \"...\"");
  file.name = name.value_or("");
  file.where = top.where("name");
  const auto convention = top.word("convention", {"standard", "modified"});
  file.modified = convention == 1;
  file.human = top.word("profile", {"human", "none"}) == 0;
  file.units = read_units(top);
  if (const auto g = top.numbers("gravity", 3)) file.gravity = {(*g)[0], (*g)[1], (*g)[2]};
  if (const auto path = top.text("anthropometry")) {
    file.anthropometry = *path;
    file.anthropometry_at = top.where("anthropometry");
  }
  if (const DhValue* lengths = top.find("lengths"))
    read_lengths(*lengths, file.units, report, true, file);
  for (const char* key : {"root", "joints", "frames", "segments", "points", "mirror", "postures"})
    top.find(key);
  top.unknown_keys();
  if (!top.has("frames"))
    report.error({1, 1}, "", "[[frames]] are missing", "the rows of the table: see docs/dh.md");
  return file;
}

void read_body(const DhValue& document, const DhReport& report, DhFile& file) {
  DhTable top(document, "", report);
  const DhValue* joints = top.find("joints");
  if (joints != nullptr) read_joint_names(*joints, report, file);
  if (const DhValue* root = top.find("root")) read_root(*root, report, file);
  if (const DhValue* frames = top.find("frames")) read_rows(*frames, report, file);
  if (joints != nullptr) read_joints(*joints, report, file);
  if (const DhValue* segments = top.find("segments")) read_segments(*segments, report, file);
  if (const DhValue* points = top.find("points")) read_points(*points, report, file);
  if (const DhValue* mirrors = top.find("mirror")) read_mirrors(*mirrors, report, file);
  if (const DhValue* postures = top.find("postures")) read_postures(*postures, report, file);
  const bool has_cells = std::any_of(file.rows.begin(), file.rows.end(),
                                     [](const DhRow& row) { return !row.is_placed; });
  if (has_cells && !top.has("convention"))
    report.error({1, 1}, "", "convention is missing",
                 "write convention = \"standard\" (theta d a alpha of a row lead from the frame "
                 "before to its own) or \"modified\" (alpha a theta d do)");
  check_names(report, file);
}

void override_lengths(const DhValue& document, const DhReport& report, bool is_own, DhFile& file) {
  DhTable top(document, "", report);
  const DhUnits units = read_units(top);
  if (const DhValue* lengths = top.find("lengths"))
    read_lengths(*lengths, units, report, is_own, file);
  for (const char* key : {"name", "segments"}) top.find(key);
  top.unknown_keys();
}

void override_masses(const DhValue& document, const DhReport& report, DhFile& file) {
  DhTable top(document, "", report);
  const DhValue* segments = top.find("segments");
  if (segments == nullptr) return;
  DhTable table(*segments, "segments", report);
  if (!table.is_table()) return;
  Findings said_already("");  // faults of the units were reported with the lengths
  const DhReport unheard{said_already};
  DhTable again(document, "", unheard);
  const DhUnits units = read_units(again);
  for (const DhValue::Entry& entry : segments->entries) {
    DhTable one(entry.value, named("segment", entry.key), report);
    DhMass* mass = nullptr;
    std::vector<std::string_view> names;
    for (DhSegment& s : file.segments) {
      names.push_back(s.name);
      if (s.name == entry.key) mass = &s.mass;
    }
    for (DhRow& row : file.rows) {
      if (!row.mass) continue;
      names.push_back(row.name);
      if (row.name == entry.key) mass = &*row.mass;
    }
    if (mass == nullptr) {
      const std::string meant = nearest(entry.key, names);
      report.error(entry.where, named("segment", entry.key), "the model has no such segment",
                   meant.empty() ? "" : fmt::format("did you mean {}?", quoted(meant)));
      continue;
    }
    if (!one.is_table()) continue;
    mass->file = report.file;
    mass->where = entry.where;
    read_mass(one, units, file, *mass);
    const DhTurn turn = read_turn(one, units);
    if (one.has("rpy") || one.has("rotation")) mass->axes = turn;
    one.unknown_keys();
  }
}

DhLinear read_cell(const DhValue& value, const std::string& element, const std::string& about,
                   DhQuantity quantity, const DhUnits& units, const DhReport& report,
                   DhFile& file) {
  const auto in_si = [&](double x) {
    return quantity == DhQuantity::kAngle ? units.angle(x) : x / units.length;
  };
  DhLinear result;
  if (value.kind != DhValue::Kind::kText) {
    if (const auto x = finite_number(value, element, about, report)) result.constant = in_si(*x);
    return result;
  }
  const DhFind find = [&](std::string_view word, DhSymbol& symbol) {
    const auto found = file.symbols.find(std::string(word));
    if (found != file.symbols.end()) symbol = found->second;
    return found != file.symbols.end();
  };
  DhExpression e = parse_expression(value.text, find);
  const Location place{value.where.line, value.where.column + 1 + static_cast<int>(e.at)};
  if (!e.fault.empty()) {
    if (e.hint == "?") {
      std::vector<std::string_view> names;
      for (const DhJoint& joint : file.joints) names.push_back(joint.name);
      for (const DhLength& length : file.lengths) names.push_back(length.name);
      const size_t begin = e.fault.find('\'') + 1;
      const std::string meant =
          nearest(std::string_view(e.fault).substr(begin, e.fault.rfind('\'') - begin), names);
      e.hint = meant.empty() ? "lengths are declared in [lengths], joints in [joints]"
                             : fmt::format("did you mean {}?", quoted(meant));
    }
    report.error(place, element, about + e.fault, e.hint);
    return result;
  }
  if (e.value.has_pi && (quantity == DhQuantity::kLength || units.degrees))
    report.error(value.where, element,
                 fmt::format("{}pi in {}", about,
                             quantity == DhQuantity::kLength ? "a length" : "an angle in degrees"),
                 quantity == DhQuantity::kLength ? "" : "write 180, or state angle = \"rad\"");
  result = e.value;
  result.constant = in_si(result.constant);
  for (const auto& [symbol, factor] : result.terms) {
    const auto k = static_cast<size_t>(symbol.index);
    if (symbol.kind == DhSymbol::Kind::kLength) {
      file.lengths[k].used = true;
      if (quantity == DhQuantity::kAngle)
        report.error(
            value.where, element,
            fmt::format("{}the length {} in an angle", about, quoted(file.lengths[k].name)));
    }
  }
  return result;
}

void read_xyz(DhTable& table, const char* key, const DhUnits& units, DhFile& file, DhVector& xyz) {
  const DhValue* value = table.find(key);
  if (value == nullptr) return;
  if (value->kind != DhValue::Kind::kList || value->items.size() != 3) {
    table.error(key, "is not a list of three lengths");
    return;
  }
  for (size_t i = 0; i < 3; ++i) {
    xyz[i] = read_cell(value->items[i], table.element(), std::string(key) + ": ",
                       DhQuantity::kLength, units, table.report(), file);
    for (const auto& term : xyz[i].terms)
      if (term.first.kind == DhSymbol::Kind::kJoint) table.error(key, "a joint cannot stand here");
  }
}

int row_called(const std::string& name, Location where, const std::string& element,
               const DhReport& report, const DhFile& file) {
  if (name == file.root.frame) return -1;
  const auto found = file.row_index.find(name);
  if (found != file.row_index.end()) return found->second;
  constexpr std::string_view kSuffix = ".private";
  if (name.ends_with(kSuffix)) {
    const auto row = file.row_index.find(name.substr(0, name.size() - kSuffix.size()));
    if (row != file.row_index.end() && file.rows[static_cast<size_t>(row->second)].joint >= 0)
      return kPrivateFrame + row->second;
  }
  std::vector<std::string_view> names{file.root.frame};
  for (const DhRow& row : file.rows) names.push_back(row.name);
  const std::string meant = nearest(name, names);
  report.error(where, element, fmt::format("there is no frame {}", quoted(name)),
               meant.empty() ? "a frame stands above the rows and points that hang on it"
                             : fmt::format("did you mean {}?", quoted(meant)));
  return -2;
}

}  // namespace arboc

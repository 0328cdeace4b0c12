// [[frames]]: the rows of the table.
#include <fmt/format.h>

#include <unordered_map>

#include "base/words.h"
#include "frontend/dh_file.h"

namespace arboc {
namespace {

constexpr size_t kMaxRows = 20000;

class RowReader {
 public:
  RowReader(const DhReport& report, DhFile& file) : report_(report), file_(file) {}

  void read(const DhValue& value) {
    DhTable nameless(value, "row", report_);
    if (!nameless.is_table()) return;
    const auto name = nameless.text("name");
    if (!name) {
      if (!nameless.has("name"))
        report_.error(value.where, fmt::format("row {}", file_.rows.size() + 1), "name is missing");
      return;
    }
    DhTable table(value, named("row", *name), report_);
    DhRow row;
    row.name = *table.text("name");
    row.note = table.text("note").value_or("");
    row.where = value.where;
    row.parent = parent(table);
    row.is_placed = table.has("xyz") || table.has("rpy") || table.has("rotation");
    if (row.is_placed)
      place(table, row);
    else
      cells(table, row);
    if (const auto joint = table.text("joint")) row.joint = joint_called(table, *joint);
    if (table.has("mass") || table.has("cg") || table.has("inertia")) {
      row.mass.emplace();
      row.mass->where = row.where;
      read_mass(table, file_.units, file_, *row.mass);
    }
    for (const char* key : {"xyz", "rpy", "rotation", "theta", "d", "alpha", "a"}) table.find(key);
    for (const char* key : {"mass", "cg", "inertia", "inertia_about"}) table.find(key);
    table.unknown_keys();
    use_joints(table, row);
    file_.row_index.emplace(row.name, static_cast<int>(file_.rows.size()));
    file_.rows.push_back(std::move(row));
  }

 private:
  int parent(DhTable& table) {
    const auto name = table.text("parent");
    if (!name) return static_cast<int>(file_.rows.size()) - 1;
    return std::max(
        row_called(*name, table.where("parent"), table.element() + ": parent", report_, file_), -1);
  }

  void place(DhTable& table, DhRow& row) {
    for (const char* key : {"theta", "d", "alpha", "a"})
      if (table.has(key))
        table.error(key, "a row has either cells (theta, d, alpha, a) or a placement (xyz, rpy)");
    read_xyz(table, "xyz", file_.units, file_, row.xyz);
    row.turn = read_turn(table, file_.units);
  }

  DhLinear cell(DhTable& table, const char* key, DhQuantity quantity) {
    const DhValue* value = table.find(key);
    if (value == nullptr) {
      report_.error(table.where(), table.element(), fmt::format("the cell {} is missing", key),
                    "write 0 where it is 0");
      return {};
    }
    return read_cell(*value, table.element(), std::string(key) + ": ", quantity, file_.units,
                     report_, file_);
  }

  /// Splits the joint off.
  DhCell driven(DhTable& table, const char* key, DhQuantity quantity) {
    DhCell result;
    for (const auto& [symbol, factor] : (result.value = cell(table, key, quantity)).terms) {
      if (symbol.kind != DhSymbol::Kind::kJoint) continue;
      if (result.joint >= 0)
        table.error(key, "two joints in one cell", "write two rows, or a joint that drives both");
      result.joint = symbol.index;
      result.factor = factor;
    }
    std::erase_if(result.value.terms,
                  [](const auto& term) { return term.first.kind == DhSymbol::Kind::kJoint; });
    return result;
  }

  void cells(DhTable& table, DhRow& row) {
    row.theta = driven(table, "theta", DhQuantity::kAngle);
    row.d = driven(table, "d", DhQuantity::kLength);
    for (const auto& [key, quantity, value] : {std::tuple{"alpha", DhQuantity::kAngle, &row.alpha},
                                               std::tuple{"a", DhQuantity::kLength, &row.a}}) {
      *value = cell(table, key, quantity);
      for (const auto& term : value->terms)
        if (term.first.kind == DhSymbol::Kind::kJoint)
          table.error(key, "a joint moves theta or d, not this");
      std::erase_if(value->terms,
                    [](const auto& term) { return term.first.kind == DhSymbol::Kind::kJoint; });
    }
    if (row.theta.joint >= 0 && row.d.joint >= 0)
      table.error("d", "theta and d of one row are moved by joints", "write two rows");
  }

  int joint_called(DhTable& table, const std::string& name) {
    const auto found = file_.symbols.find(name);
    if (found != file_.symbols.end() && found->second.kind == DhSymbol::Kind::kJoint)
      return found->second.index;
    std::vector<std::string_view> names;
    for (const DhJoint& joint : file_.joints) names.push_back(joint.name);
    const std::string meant = nearest(name, names);
    table.error("joint", fmt::format("there is no joint {}", quoted(name)),
                meant.empty() ? "joints are declared in [joints]"
                              : fmt::format("did you mean {}?", quoted(meant)));
    return -1;
  }

  void use_joints(DhTable& table, const DhRow& row) {
    const auto use = [&](int k, const char* key, bool slides) {
      if (k < 0) return;
      DhJoint& joint = file_.joints[static_cast<size_t>(k)];
      const std::string whose = named("joint", joint.name);
      if (joint.axes.empty() == (key[0] == 'j')) {
        table.error(key,
                    joint.axes.empty() ? fmt::format("{} has no axes", whose)
                                       : fmt::format("{} has axes {}", whose, joint.axes),
                    joint.axes.empty() ? "give them in [joints], axes = \"Z\", or write the joint "
                                         "into the cell theta or d"
                                       : "name it by the key 'joint', not in a cell");
      } else if (joint.uses > 0 && joint.slides != slides) {
        table.error(key, fmt::format("{} turns one row and slides another", whose));
      } else if (joint.uses > 0 && !joint.axes.empty()) {
        table.error(key, fmt::format("{} moves another row already", whose),
                    "a joint with axes moves one");
      }
      joint.slides = slides;
      ++joint.uses;
    };
    use(row.theta.joint, "theta", false);
    use(row.d.joint, "d", true);
    use(row.joint, "joint", false);
    if (row.joint >= 0 && (row.theta.joint >= 0 || row.d.joint >= 0))
      table.error("joint", "a cell of the row names a joint as well");
  }

  const DhReport& report_;
  DhFile& file_;
};

}  // namespace

void read_rows(const DhValue& frames, const DhReport& report, DhFile& file) {
  if (frames.kind != DhValue::Kind::kList || frames.items.empty()) {
    report.error(frames.where, "frames", "is not a list of rows", "write [[frames]] or a list");
    return;
  }
  if (frames.items.size() > kMaxRows) {
    report.error(frames.where, "frames", fmt::format("{} rows", frames.items.size()),
                 fmt::format("the limit is {}", kMaxRows));
    return;
  }
  RowReader reader(report, file);
  for (const DhValue& row : frames.items) reader.read(row);
}

}  // namespace arboc

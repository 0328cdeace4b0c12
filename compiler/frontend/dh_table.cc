#include "frontend/dh_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/exact_trig.h"
#include "base/words.h"

namespace arboc {
namespace {

/// Words of other programs' tables -> ours.
struct Foreign {
  std::string_view theirs;
  const char* ours;
};
constexpr Foreign kForeign[] = {
    {"Jm", "the rotor's inertia is 'rotor', its gear ratio 'gear'"},
    {"G", "the gear ratio is 'gear'"},
    {"B", "viscous friction is 'damping'"},
    {"Tc", "Coulomb friction is 'friction'"},
    {"m", "a mass is 'mass'"},
    {"r", "a centre of mass is 'cg'"},
    {"com", "a centre of mass is 'cg'"},
    {"centre", "a centre of mass is 'cg'"},
    {"I", "an inertia is 'inertia'"},
    {"qlim", "limits are 'limits', in [joints]"},
    {"offset", "write it in the cell: theta = \"q1 + pi/2\""},
    {"sigma", "the joint's name in the cell 'd' makes a sliding joint"},
    {"type",
     "the joint's name in the cell 'theta' makes a turning joint, in 'd' a sliding one; "
     "'axes' is for joints with several"},
    {"convention", "one convention holds for the whole file: write it once, at the top"},
    {"effort", "limits of the torque are 'torque'"},
};

/// A number, or an expression without names, of a list called rpy.
double angle(const DhValue& value, const DhTable& table, const DhUnits& units) {
  if (value.kind != DhValue::Kind::kText)
    return units.angle(finite_number(value, table.element(), "rpy: ", table.report()).value_or(0));
  const DhExpression e =
      parse_expression(value.text, [](std::string_view, DhSymbol&) { return false; });
  if (!e.fault.empty())
    table.report().error(value.where, table.element(), "rpy: " + e.fault,
                         e.hint == "?" ? "no names stand here" : e.hint);
  if (e.value.has_pi && units.degrees)
    table.report().error(value.where, table.element(), "rpy: pi in an angle in degrees",
                         "write 180, or state angle = \"rad\"");
  return units.angle(e.value.constant);
}

}  // namespace

double DhUnits::angle(double written) const {
  if (!degrees) return written;
  const double multiple = written / 15;
  const double nearest = std::nearbyint(multiple);
  if (multiple == nearest && std::fabs(nearest) < 1e6) return degrees15(std::lround(nearest));
  return written * (std::numbers::pi / 180);
}

DhTable::DhTable(const DhValue& value, std::string element, const DhReport& report)
    : value_(value), element_(std::move(element)), report_(report) {
  if (!is_table())
    report.error(value.where, element_,
                 fmt::format("is {} where a table is needed", value.kind_name()),
                 "write { key = value, ... }");
}

const DhValue* DhTable::find(const char* key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  for (const DhValue::Entry& entry : value_.entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

bool DhTable::has(const char* key) const {
  for (const DhValue::Entry& entry : value_.entries)
    if (entry.key == key) return true;
  return false;
}

Location DhTable::where(const char* key) const {
  for (const DhValue::Entry& entry : value_.entries)
    if (entry.key == key) return entry.value.where;
  return value_.where;
}

void DhTable::error(const char* key, std::string message, std::string hint) const {
  report_.error(where(key), element_, fmt::format("{}: {}", key, message), std::move(hint));
}

std::optional<std::string> DhTable::text(const char* key) {
  const DhValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind == DhValue::Kind::kText && !value->text.empty()) return value->text;
  error(key, value->kind == DhValue::Kind::kText
                 ? "is empty"
                 : fmt::format("is {} where text is needed", value->kind_name()));
  return std::nullopt;
}

std::optional<bool> DhTable::flag(const char* key) {
  const DhValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind == DhValue::Kind::kFlag) return value->flag;
  error(key, fmt::format("is {} where true or false is needed", value->kind_name()));
  return std::nullopt;
}

std::optional<double> finite_number(const DhValue& value, const std::string& element,
                                    const std::string& about, const DhReport& report) {
  if (value.kind != DhValue::Kind::kNumber) {
    report.error(value.where, element,
                 fmt::format("{}is {} where a number is needed", about, value.kind_name()));
  } else if (!std::isfinite(value.number)) {
    report.error(value.where, element,
                 fmt::format("{}{} is not a finite number", about, quoted(value.text)),
                 "leave out what has no limit");
  } else if (value.text.find_first_of("xob") != std::string::npos) {
    report.error(value.where, element,
                 fmt::format("{}{} is not a decimal number", about, quoted(value.text)));
  } else {
    return value.number;
  }
  return std::nullopt;
}

std::optional<double> DhTable::number(const char* key) {
  const DhValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  return finite_number(*value, element_, std::string(key) + ": ", report_);
}

std::optional<std::vector<double>> DhTable::numbers(const char* key, size_t count) {
  const DhValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  if (value->kind != DhValue::Kind::kList || value->items.size() != count) {
    error(key,
          value->kind != DhValue::Kind::kList
              ? fmt::format("is {} where a list of {} numbers is needed", value->kind_name(), count)
              : fmt::format("has {} entr{} where {} are needed", value->items.size(),
                            value->items.size() == 1 ? "y" : "ies", count));
    return std::nullopt;
  }
  std::vector<double> result;
  for (const DhValue& item : value->items) {
    const auto x = finite_number(item, element_, std::string(key) + ": ", report_);
    if (!x) return std::nullopt;
    result.push_back(*x);
  }
  return result;
}

std::optional<size_t> DhTable::word(const char* key, const std::vector<std::string_view>& words) {
  const auto given = text(key);
  if (!given) return std::nullopt;
  for (size_t k = 0; k < words.size(); ++k)
    if (words[k] == *given) return k;
  std::string list;
  for (const std::string_view w : words) list += (list.empty() ? "" : ", ") + std::string(w);
  const std::string meant = nearest(*given, words);
  error(key, "there is no " + quoted(*given),
        meant.empty() ? "known are " + list : fmt::format("did you mean {}?", quoted(meant)));
  return std::nullopt;
}

std::optional<std::vector<std::string>> DhTable::texts(const char* key) {
  const DhValue* value = find(key);
  if (value == nullptr) return std::nullopt;
  std::vector<std::string> result;
  bool good = value->kind == DhValue::Kind::kList;
  for (const DhValue& item : value->items) {
    good = good && item.kind == DhValue::Kind::kText;
    result.push_back(item.text);
  }
  if (good) return result;
  error(key, "is not a list of texts");
  return std::nullopt;
}

void DhTable::unknown_keys() {
  for (const DhValue::Entry& entry : value_.entries) {
    bool is_known = false;
    for (const std::string_view k : known_) is_known = is_known || k == entry.key;
    if (is_known) continue;
    std::string hint;
    const std::string meant = nearest(entry.key, known_);
    for (const Foreign& word : kForeign)
      if (word.theirs == entry.key) hint = word.ours;
    if (hint.empty() && !meant.empty()) hint = fmt::format("did you mean {}?", quoted(meant));
    if (hint.empty()) {
      hint = "known are ";
      for (size_t k = 0; k < known_.size(); ++k)
        hint += (k == 0 ? "" : ", ") + std::string(known_[k]);
    }
    report_.error(entry.where, element_, fmt::format("there is no key {}", quoted(entry.key)),
                  hint);
  }
}

DhTurn read_turn(DhTable& table, const DhUnits& units) {
  constexpr double kRounding = 1e-6;  // of matrices written with few digits
  DhTurn result;
  if (const DhValue* rpy = table.find("rpy")) {
    if (rpy->kind != DhValue::Kind::kList || rpy->items.size() != 3)
      table.error("rpy", "is not a list of three angles");
    else
      for (int i = 0; i < 3; ++i)
        result.rpy[i] = angle(rpy->items[static_cast<size_t>(i)], table, units);
  }
  const DhValue* rows = table.find("rotation");
  if (rows == nullptr) return result;
  if (table.has("rpy")) table.error("rotation", "stands beside rpy", "write one of them");
  Matrix3<double> R;
  bool good = rows->kind == DhValue::Kind::kList && rows->items.size() == 3;
  for (size_t i = 0; good && i < 3; ++i) {
    const DhValue& row = rows->items[i];
    good = row.kind == DhValue::Kind::kList && row.items.size() == 3;
    for (size_t j = 0; good && j < 3; ++j) {
      const auto x = finite_number(row.items[j], table.element(), "rotation: ", table.report());
      if (!x) return result;
      R(static_cast<int>(i), static_cast<int>(j)) = *x;
    }
  }
  if (!good) {
    table.error("rotation", "is not three rows of three numbers");
    return result;
  }
  const Vector3<double> x = column(R, 0), y = column(R, 1), z = column(R, 2);
  const Vector3<double> off = cross(x, y) - z;
  if (std::fabs(dot(x, x) - 1) > kRounding || std::fabs(dot(y, y) - 1) > kRounding ||
      std::fabs(dot(x, y)) > kRounding || dot(off, off) > kRounding * kRounding)
    table.error("rotation", "is not a rotation: its columns are not orthonormal and right-handed");
  result.turn = R;
  return result;
}

}  // namespace arboc

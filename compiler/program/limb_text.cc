#include "program/limb_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/number.h"

namespace arboc {

std::string LimbText::number(const Lanes& value) {
  Row row{};
  for (int k = 0; k < chunk_.limbs; ++k) row[static_cast<size_t>(k)] = value[k];
  const auto [at, added] = numbers_.try_emplace(row, static_cast<int>(numbers_.size()));
  return fmt::format("T(number[{}])", at->second);
}

std::string LimbText::entry(const Row& entries) {
  const auto [at, added] = entries_.try_emplace(entries, static_cast<int>(entries_.size()));
  return fmt::format("entry[{}]", at->second);
}

std::string LimbText::own(int width, int slot) {
  own_width_ = width;
  return fmt::format("own[{}]", slot);
}

std::string LimbText::name(const Operand& x) {
  if (x.width == 1 || x.lane >= 0) return unsigned_text(program_, x);
  switch (x.place) {
    case Operand::Place::kConstant: return number(x.value);
    case Operand::Place::kSlot:
      if (!x.sine) return own(x.width, x.index);
      return x.index == 0 ? "w[limb]" : fmt::format("w[{} + limb]", x.index);
    default: return fmt::format("x{}", x.index);
  }
}

std::string LimbText::value(const Statement& s) {
  if (s.op != Op::kPack) {
    Statement scalar = s;
    scalar.width = 1;
    return text(scalar, [this](const Operand& x) { return name(x); });
  }
  Row row{};
  for (size_t k = 0; k < static_cast<size_t>(chunk_.limbs); ++k) row[k] = s.terms[k].a.index;
  const Operand& first = s.terms[0].a;
  return fmt::format("{}{}[{}]", first.negative ? "-" : "",
                     program_.inputs[static_cast<size_t>(first.port)].name, entry(row));
}

std::vector<std::string> LimbText::stores(const Statement& s) {
  std::vector<std::string> lines;
  if (s.slot >= 0) lines.push_back(fmt::format("{} = x{}", own(s.width, s.slot), s.local));
  std::vector<Store> rest = s.stores;
  while (!rest.empty()) {
    const Store first = rest.front();
    const std::string& port = program_.outputs[static_cast<size_t>(first.port)].name;
    const std::string value = fmt::format("{}x{}", first.value.negative ? "-" : "", s.local);
    Row row{};
    std::vector<size_t> taken;
    for (int lane = 0; lane < chunk_.limbs; ++lane) {
      const auto at = std::find_if(rest.begin(), rest.end(), [&](const Store& x) {
        return x.port == first.port && x.value.negative == first.value.negative &&
               x.value.lane == lane;
      });
      if (at == rest.end()) break;
      row[static_cast<size_t>(lane)] = at->index;
      taken.push_back(static_cast<size_t>(at - rest.begin()));
    }
    if (taken.size() == static_cast<size_t>(chunk_.limbs)) {
      lines.push_back(fmt::format("{}[{}] = {}", port, entry(row), value));
    } else {  // not every limb has this entry
      lines.push_back(
          fmt::format("if (limb == {}) {}[{}] = {}", first.value.lane, port, first.index, value));
      taken = {0};
    }
    std::sort(taken.rbegin(), taken.rend());
    for (const size_t k : taken) rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
  }
  return lines;
}

void LimbText::add_table(const std::map<Row, int>& entries, const Named& named,
                         const std::string& part, Tables& tables) const {
  if (entries.empty()) return;
  std::vector<const Row*> columns(entries.size());
  for (const auto& [row, column] : entries) columns[static_cast<size_t>(column)] = &row;
  std::string text;
  for (size_t limb = 0; limb < static_cast<size_t>(chunk_.limbs); ++limb) {
    std::string list;
    for (const Row* column : columns)
      list += (list.empty() ? "" : ", ") + shortest((*column)[limb]);
    text += fmt::format("{}{{{}}}", limb ? ", " : "", list);
  }
  tables.definitions.push_back(
      fmt::format("template <class T>\nstatic constexpr {} {}_{}[{}][{}] = {{{}}}", named.type,
                  part, named.name, chunk_.limbs, columns.size(), text));
  tables.rows.push_back(
      fmt::format("const {0}* const {1} = {2}_{1}<T>[limb]", named.type, named.name, part));
}

LimbText::Tables LimbText::tables(const std::string& part) const {
  Tables tables;
  add_table(numbers_, {"arboc::real_t<T>", "number"}, part, tables);
  const bool small = std::all_of(entries_.begin(), entries_.end(), [](const auto& row) {
    return *std::max_element(row.first.begin(), row.first.end()) < 65536;
  });
  add_table(entries_, {small ? "unsigned short" : "unsigned", "entry"}, part, tables);
  if (own_width_ > 0)
    tables.rows.push_back(
        fmt::format("T* const own = w{} + {} * limb", own_width_, program_.lane_slots[own_width_]));
  return tables;
}

}  // namespace arboc

#include "emit/cpp_stores.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace arboc {
namespace {

/// Lanes 0, 1 ... of one vector with one sign, or a single value.
struct Group {
  size_t statement = 0;
  std::vector<Store> stores;
  bool taken = false;
};

/// Vectors wait for their neighbours as long: longer they would be spilled.
constexpr size_t kWindow = 80;

class Planner {
 public:
  Planner(const Program& program, const Chunk& chunk)
      : program_(program), chunk_(chunk), lines_(chunk.statements.size()) {
    for (size_t i = 0; i < chunk.statements.size(); ++i) collect(i);
  }

  std::vector<std::vector<std::string>> run() {
    transpose();
    for (const Group& group : groups_)
      if (!group.taken) lines_[group.statement].push_back(line(group));
    return std::move(lines_);
  }

 private:
  void collect(size_t i) {
    const Statement& s = chunk_.statements[i];
    std::vector<Store> rest = s.stores;
    while (!rest.empty()) {
      Group group{i, {rest.front()}};
      rest.erase(rest.begin());
      for (int lane = 1; lane < s.width && group.stores[0].value.lane == 0; ++lane) {
        const auto next = std::find_if(rest.begin(), rest.end(), [&](const Store& x) {
          return x.value.lane == lane && x.value.negative == group.stores[0].value.negative;
        });
        if (next == rest.end()) break;
        group.stores.push_back(*next);
        rest.erase(next);
      }
      groups_.push_back(std::move(group));
    }
  }

  using Place = std::tuple<int, std::vector<int>>;  // port, entry of each lane
  static Place place(const Group& group, int behind) {
    std::vector<int> entries;
    for (const Store& x : group.stores) entries.push_back(x.index + behind);
    return {group.stores[0].port, entries};
  }

  void transpose() {
    std::map<Place, size_t> full;
    for (size_t g = 0; g < groups_.size(); ++g)
      if (groups_[g].stores.size() == 4) full[place(groups_[g], 0)] = g;
    for (const auto& [where, first] : full) {
      std::vector<size_t> rows;
      for (int k = 0; k < 4; ++k) {
        const auto next = full.find(place(groups_[first], k));
        if (next == full.end() || groups_[next->second].taken) break;
        rows.push_back(next->second);
      }
      if (rows.size() == 4) store_rows(rows);
    }
  }

  void store_rows(const std::vector<size_t>& rows) {
    const auto [early, late] = std::minmax_element(rows.begin(), rows.end());
    const size_t last = groups_[*late].statement;
    if (last - groups_[*early].statement > kWindow) return;
    std::string values;
    for (const size_t g : rows) {
      groups_[g].taken = true;
      values += (values.empty() ? "" : ", ") + vector(groups_[g]);
    }
    lines_[last].push_back(
        fmt::format("arboc::store_rows({}{})", values, places(groups_[rows[0]])));
  }

  std::string name(const Store& x) const {
    return program_.outputs[static_cast<size_t>(x.port)].name;
  }
  std::string vector(const Group& group) const {
    return fmt::format("{}x{}", group.stores[0].value.negative ? "-" : "",
                       chunk_.statements[group.statement].local);
  }
  std::string places(const Group& group) const {
    std::string out;
    for (const Store& x : group.stores) out += fmt::format(", {} + {}", name(x), x.index);
    return out;
  }
  std::string line(const Group& group) const {
    const Store& first = group.stores[0];
    if (group.stores.size() == 1)
      return fmt::format("{}[{}] = {}", name(first), first.index, text(program_, first.value));
    return fmt::format("arboc::scatter({}{})", vector(group), places(group));
  }

  const Program& program_;
  const Chunk& chunk_;
  std::vector<Group> groups_;
  std::vector<std::vector<std::string>> lines_;
};

}  // namespace

std::vector<std::vector<std::string>> store_lines(const Program& program, const Chunk& chunk) {
  return Planner(program, chunk).run();
}

}  // namespace arboc

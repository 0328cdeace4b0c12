#include "program/limb_phases.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace arboc {
namespace {

constexpr int kScalars = -1;

class Phases {
 public:
  Phases(const Region& region, const std::vector<char>& placed)
      : in_(region),
        placed_(placed),
        group_(region.nodes.size(), kScalars),
        phase_(region.nodes.size(), kPending) {
    find_groups();
    count_limbs();
  }

  std::vector<Phase> run() {
    auto left = std::count(placed_.begin(), placed_.end(), 0);
    size_t done = 0;
    while (left > 0) {
      for (int group = kScalars; group < groups_; ++group) take(group);
      const size_t before = done;
      done = 0;
      for (const Phase& phase : out_) done += phase.nodes.size();
      if (done == before) throw std::logic_error("limb_phases: nodes wait for each other");
      left -= static_cast<std::ptrdiff_t>(done - before);
    }
    return std::move(out_);
  }

 private:
  static constexpr int kPending = -1;

  bool is_wide(std::uint32_t n) const {
    const Node& node = in_.nodes[n];
    return !placed_[n] && node.width > 1 && (node.op != Op::kPack || gathers_input(in_, node));
  }

  /// Values in lanes that meet belong to one group.
  void find_groups() {
    std::vector<std::uint32_t> parent(in_.nodes.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t n) {
      while (parent[n] != n) n = parent[n] = parent[parent[n]];
      return n;
    };
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n)
      if (is_wide(n))
        for_each_operand(in_, in_.nodes[n], [&](Ref r) {
          if (is_wide(r.node())) parent[root(r.node())] = root(n);
        });
    std::vector<int> number(in_.nodes.size(), kScalars);
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n) {
      if (!is_wide(n)) continue;
      int& of_root = number[root(n)];
      if (of_root == kScalars) of_root = groups_++;
      group_[n] = of_root;
    }
  }

  /// Three limbs leave the last of four lanes idle.
  void count_limbs() {
    limbs_.assign(static_cast<size_t>(groups_), 1);
    for (const Node& node : in_.nodes) {
      if (node.op != Op::kLane && node.op != Op::kHsum) continue;
      if (group_[node.a.node()] == kScalars) continue;
      int& limbs = limbs_[static_cast<size_t>(group_[node.a.node()])];
      limbs = std::max(limbs, static_cast<int>(node.index) + (node.op == Op::kLane ? 1 : 0));
    }
  }

  bool ready(std::uint32_t n, int phase) const {
    bool all = true;
    for_each_operand(in_, in_.nodes[n], [&](Ref r) {
      const bool lane = in_[r].op == Op::kLane;
      const std::uint32_t source = lane ? in_[r].a.node() : r.node();
      if (placed_[source]) return;
      all = all && phase_[source] != kPending && (!lane || phase_[source] < phase);
    });
    return all;
  }

  void take(int group) {
    const int phase = static_cast<int>(out_.size());
    Phase next{group == kScalars ? 0 : limbs_[static_cast<size_t>(group)], {}};
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n) {
      if (placed_[n] || group_[n] != group || phase_[n] != kPending || !ready(n, phase)) continue;
      phase_[n] = phase;
      next.nodes.push_back(n);
    }
    if (!next.nodes.empty()) out_.push_back(std::move(next));
  }

  const Region& in_;
  const std::vector<char>& placed_;
  std::vector<int> group_;  ///< per node
  int groups_ = 0;
  std::vector<int> limbs_;  ///< per group
  std::vector<int> phase_;  ///< per node
  std::vector<Phase> out_;
};

}  // namespace

bool gathers_input(const Region& region, const Node& node) {
  const auto port = [&](Ref r) {
    int entry = static_cast<int>(region[r].index), p = 0;
    while (entry >= region.inputs[static_cast<size_t>(p)].size)
      entry -= region.inputs[static_cast<size_t>(p++)].size;
    return p;
  };
  const Ref first = region.terms[node.index].a;
  if (region[first].op != Op::kInput) return false;
  for (std::uint32_t t = node.index; t < node.index + node.count; ++t) {
    const Ref r = region.terms[t].a;
    if (region[r].op != Op::kInput || r.negative() != first.negative() || port(r) != port(first))
      return false;
  }
  return true;
}

std::vector<Phase> limb_phases(const Region& region, const std::vector<char>& placed) {
  return Phases(region, placed).run();
}

}  // namespace arboc

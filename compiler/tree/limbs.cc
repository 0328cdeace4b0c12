#include "tree/limbs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/diagnostic.h"
#include "base/number.h"

namespace arboc {
namespace {

class Finder {
 public:
  explicit Finder(const DynamicTree& tree)
      : tree_(tree), children_(tree.body.size()), shape_(tree.body.size()) {
    for (int i = 1; i <= tree.nb(); ++i) children_[at(body(i).parent)].push_back(i);
    for (int i = tree.nb(); i > 0; --i) describe(i);
  }

  std::vector<LimbGroup> run(int most) {
    search(0, most);
    std::sort(groups_.begin(), groups_.end(),
              [](const LimbGroup& a, const LimbGroup& b) { return a.limb[0][0] < b.limb[0][0]; });
    return std::move(groups_);
  }

 private:
  static size_t at(int i) { return static_cast<size_t>(i); }
  const BodyOf<double>& body(int i) const { return tree_.body[at(i)]; }

  /// The shape of a subtree, whatever the order of its branches: they are sorted by their shapes.
  void describe(int i) {
    std::vector<int>& below = children_[at(i)];
    std::stable_sort(below.begin(), below.end(),
                     [&](int a, int b) { return shape_[at(a)] < shape_[at(b)]; });
    const Body& b = body(i);
    shape_[at(i)] = fmt::format("{}{} {} {}(", static_cast<int>(b.motion), b.circle ? "c" : "",
                                shortest(b.multiplier), shortest(b.offset));
    for (const int child : below) shape_[at(i)] += shape_[at(child)];
    shape_[at(i)] += ')';
  }

  /// The bodies of a subtree in the order of their shapes; parents first.
  std::vector<int> parts(int root) const {
    std::vector<int> list{root};
    for (size_t k = 0; k < list.size(); ++k)
      for (const int child : children_[at(list[k])]) list.push_back(child);
    return list;
  }

  /// Which parts share a coordinate, by the first that has it; empty if others have it too.
  std::vector<int> sharing(const std::vector<int>& limb) const {
    std::map<int, int> first;
    std::vector<int> shared;
    for (size_t k = 0; k < limb.size(); ++k)
      shared.push_back(first.emplace(body(limb[k]).v, static_cast<int>(k)).first->second);
    for (int i = 1; i <= tree_.nb(); ++i)
      if (first.contains(body(i).v) && std::find(limb.begin(), limb.end(), i) == limb.end())
        return {};
    return shared;
  }

  void search(int parent, int most) {
    std::map<std::pair<std::string, std::vector<int>>, std::vector<std::vector<int>>> alike;
    for (const int child : children_[at(parent)]) {
      std::vector<int> limb = parts(child);
      std::vector<int> shared = sharing(limb);
      if (!shared.empty())
        alike[{shape_[at(child)], std::move(shared)}].push_back(std::move(limb));
      else
        search(child, most);
    }
    for (auto& [shape, limbs] : alike) {
      std::sort(limbs.begin(), limbs.end());
      divide(parent, limbs, most);
    }
  }

  void divide(int parent, const std::vector<std::vector<int>>& limbs, int most) {
    for (size_t k = 0; k < limbs.size(); k += at(most)) {
      const size_t end = std::min(k + at(most), limbs.size());
      if (end - k == 1)
        search(limbs[k][0], most);
      else
        groups_.push_back({parent,
                           {limbs.begin() + static_cast<std::ptrdiff_t>(k),
                            limbs.begin() + static_cast<std::ptrdiff_t>(end)}});
    }
  }

  const DynamicTree& tree_;
  std::vector<std::vector<int>> children_;  ///< per body, sorted by shape
  std::vector<std::string> shape_;
  std::vector<LimbGroup> groups_;
};

}  // namespace

std::vector<LimbGroup> find_limbs(const DynamicTree& tree, int most) {
  return Finder(tree).run(most);
}

std::string print(const DynamicTree& tree, const std::vector<LimbGroup>& groups) {
  const auto link = [&](int i) {
    return i == 0 ? "the world" : "'" + printable(tree.body[static_cast<size_t>(i)].link) + "'";
  };
  std::string out = fmt::format("limbs {}: {} groups\n", printable(tree.name), groups.size());
  for (const LimbGroup& group : groups) {
    out += fmt::format("{} limbs of {} bodies on {}:", group.limbs(), group.parts(),
                       link(group.parent));
    for (const auto& limb : group.limb) {
      out += limb == group.limb[0] ? "" : ",";
      for (const int i : limb) out += ' ' + link(i);
    }
    out += '\n';
  }
  return out;
}

}  // namespace arboc

#include "tree/coupling.h"

#include <algorithm>
#include <functional>
#include <iterator>

namespace arboc {
namespace {

/// The coordinates on the path from body i to the world, descending, each once.
std::vector<int> path(const DynamicTree& tree, int i) {
  std::vector<int> dofs;
  for (; i > 0; i = tree.body[static_cast<size_t>(i)].parent) {
    const Body& body = tree.body[static_cast<size_t>(i)];
    for (int d = freedoms(body.motion) - 1; d >= 0; --d) dofs.push_back(body.v + d);
  }
  std::sort(dofs.begin(), dofs.end(), std::greater<>());
  dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  return dofs;
}

/// Couples row list.front() with the rest of the list.
void couple(const std::vector<int>& list, std::vector<std::vector<int>>& coupled) {
  if (list.size() < 2) return;
  std::vector<int>& row = coupled[static_cast<size_t>(list.front())];
  if (row.empty()) {
    row.assign(list.begin() + 1, list.end());
    return;
  }
  std::vector<int> merged;
  std::set_union(row.begin(), row.end(), list.begin() + 1, list.end(), std::back_inserter(merged),
                 std::greater<>());
  row = std::move(merged);
}

}  // namespace

std::vector<std::vector<int>> coupling(const DynamicTree& tree) {
  std::vector<bool> leaf(tree.body.size(), true);
  for (const Body& body : tree.body)
    if (body.parent >= 0) leaf[static_cast<size_t>(body.parent)] = false;

  std::vector<std::vector<int>> coupled(static_cast<size_t>(tree.nv));
  for (int i = 1; i <= tree.nb(); ++i)
    if (leaf[static_cast<size_t>(i)]) couple(path(tree, i), coupled);
  // Eliminating a row couples all that it is coupled with.
  for (size_t j = coupled.size(); j-- > 0;) {
    const std::vector<int> row = coupled[j];
    couple(row, coupled);
  }
  return coupled;
}

}  // namespace arboc

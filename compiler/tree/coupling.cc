#include "tree/coupling.h"

#include <algorithm>
#include <functional>
#include <iterator>

namespace arboc {
namespace {

/// The coordinates on the path from body i to the world, descending, each once.
std::vector<int> path(const std::vector<Body>& bodies, size_t i) {
  std::vector<int> dofs;
  for (; i > 0; i = static_cast<size_t>(bodies[i].parent)) {
    const Body& body = bodies[i];
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

std::vector<std::vector<int>> coupling(const std::vector<Body>& body, int nv) {
  std::vector<bool> leaf(body.size(), true);
  for (const Body& b : body)
    if (b.parent >= 0) leaf[static_cast<size_t>(b.parent)] = false;

  std::vector<std::vector<int>> coupled(static_cast<size_t>(nv));
  for (size_t i = 1; i < body.size(); ++i)
    if (leaf[i]) couple(path(body, i), coupled);
  // Eliminating a row couples all that it is coupled with.
  for (size_t j = coupled.size(); j-- > 0;) {
    const std::vector<int> row = coupled[j];
    couple(row, coupled);
  }
  return coupled;
}

}  // namespace arboc

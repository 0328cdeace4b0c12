#include "functions/cheaper.h"

#include <set>
#include <utility>

#include "derive/cost.h"

namespace arboc {
namespace {

/// Keeps of each matrix what is not zero in `other` either.
void keep_common(const Traced& other, Traced& traced) {
  Region& region = traced.graph.regions.back();
  for (size_t k = 0; k < traced.patterns.size(); ++k) {
    Pattern& pattern = traced.patterns[k];
    if (pattern.row.empty()) continue;
    std::set<std::pair<int, int>> common;
    for (size_t e = 0; e < other.patterns[k].row.size(); ++e)
      common.emplace(other.patterns[k].row[e], other.patterns[k].col[e]);
    Pattern kept;
    std::vector<Ref> entries;
    for (size_t e = 0; e < pattern.row.size(); ++e) {
      if (!common.contains({pattern.row[e], pattern.col[e]})) continue;
      kept.row.push_back(pattern.row[e]);
      kept.col.push_back(pattern.col[e]);
      entries.push_back(region.results[k][e]);
    }
    pattern = std::move(kept);
    region.results[k] = std::move(entries);
    region.outputs[k].size = static_cast<int>(region.results[k].size());
  }
}

int cost(const Traced& traced) {
  const Region& region = traced.graph.regions.back();
  std::vector<Ref> roots;
  for (const std::vector<Ref>& result : region.results)
    roots.insert(roots.end(), result.begin(), result.end());
  return estimated_cost(region, roots);
}

}  // namespace

Traced cheaper(Traced a, Traced b) {
  keep_common(b, a);
  keep_common(a, b);
  return cost(b) < cost(a) ? b : a;
}

}  // namespace arboc

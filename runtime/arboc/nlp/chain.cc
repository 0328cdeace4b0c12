#include "chain.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace arboc {
inline namespace v1 {
namespace nlp {
namespace {

int size_of(const std::vector<int>& v) { return static_cast<int>(v.size()); }

}  // namespace

void Inputs::push(const Affine& a) {
  std::map<int, double> terms;
  for (const Affine::Term& t : a.terms) terms[t.of.index] += t.coefficient;
  for (const auto& [v, c] : terms) {
    if (c == 0) continue;
    variable.push_back(v);
    coefficient.push_back(c);
  }
  begin.push_back(size_of(variable));
  constant.push_back(a.constant);
}

void Inputs::evaluate(const double* x, double* values) const {
  for (int k = 0; k < size(); ++k) {
    double sum = constant[k];
    for (int n = begin[k]; n < begin[k + 1]; ++n) sum += coefficient[n] * x[variable[n]];
    values[k] = sum;
  }
}

std::vector<int> parts_of(const std::vector<int>& low, const std::vector<int>& high, int members) {
  const int n = size_of(low);
  std::vector<int> least_behind(low);  // of all items from here on
  for (int k = n - 2; k >= 0; --k) least_behind[k] = std::min(low[k], least_behind[k + 1]);
  std::vector<int> parts{0};
  int most = -1;
  for (int k = 0; k < n; ++k) {
    const int m = size_of(parts);
    const bool due = static_cast<long>(k) * members >= static_cast<long>(n) * m;
    if (m < members && due && most < least_behind[k]) parts.push_back(k);
    most = std::max(most, high[k]);
  }
  parts.resize(static_cast<std::size_t>(members), n);
  parts.push_back(n);
  return parts;
}

void GradientChain::add(const Inputs& inputs, int input, int source, double factor,
                        const std::vector<int>& target) {
  const int first = inputs.begin[input];
  for (int k = 0; k < size_of(target); ++k) {
    if (k > 0 && target[k] == target[k - 1] + 1)
      ++runs_.back().count;
    else
      runs_.push_back({target[k], source, first + k, 1, factor});
  }
}

void GradientChain::share_out(int members) {
  std::vector<int> low, high;
  for (const Run& r : runs_) {
    low.push_back(r.target);
    high.push_back(r.target + r.count - 1);
  }
  parts_ = parts_of(low, high, members);
}

void GradientChain::run(const Inputs& inputs, int member, const double* source,
                        double* target) const {
  const double* coefficients = inputs.coefficient.data();
  for (int k = parts_[member]; k < parts_[member + 1]; ++k) {
    const Run& r = runs_[k];
    const double x = r.factor * source[r.source];
    for (int n = 0; n < r.count; ++n) target[r.target + n] += x * coefficients[r.coefficient + n];
  }
}

void LowerTriangle::add(int i, int j) {
  columns_[static_cast<std::size_t>(std::max(i, j))].push_back(std::min(i, j));
}

void LowerTriangle::finish() {
  int first = 0;
  for (std::vector<int>& row : columns_) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    first_.push_back(first);
    first += size_of(row);
  }
}

int LowerTriangle::entry(int i, int j) const {
  const auto row = static_cast<std::size_t>(std::max(i, j));
  const auto& columns = columns_[row];
  const auto at = std::lower_bound(columns.begin(), columns.end(), std::min(i, j));
  return first_[row] + static_cast<int>(at - columns.begin());
}

void HessianChain::begin_evaluation(const Inputs& inputs, int first, int last) {
  first_input_ = first;
  first_bundle_ = static_cast<int>(bundles_.size());
  // Inputs with a variable in common have one root.
  std::vector<int> root(static_cast<std::size_t>(last - first));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int k) {
    while (root[k] != k) k = root[k] = root[root[k]];
    return k;
  };
  std::map<int, int> owner;  // of variables
  for (int k = first; k < last; ++k)
    for (int n = inputs.begin[k]; n < inputs.begin[k + 1]; ++n) {
      const int other = owner.try_emplace(inputs.variable[n], k - first).first->second;
      root[find(k - first)] = find(other);
    }
  std::map<int, std::vector<int>> members;
  for (int k = first; k < last; ++k)
    if (inputs.begin[k] < inputs.begin[k + 1]) members[find(k - first)].push_back(k);
  bundle_of_.assign(root.size(), -1);
  place_of_.assign(root.size(), -1);
  for (const auto& [of, group] : members) add_bundle(inputs, group);
  const std::size_t count = bundles_.size() - static_cast<std::size_t>(first_bundle_);
  draft_of_.assign(count * count, -1);
}

void HessianChain::add_bundle(const Inputs& inputs, const std::vector<int>& members) {
  Bundle bundle;
  auto& all = bundle.variables;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const int k = members[i];
    place_of_[k - first_input_] = static_cast<int>(i);
    bundle_of_[k - first_input_] = static_cast<int>(bundles_.size());
    all.insert(all.end(), inputs.variable.begin() + inputs.begin[k],
               inputs.variable.begin() + inputs.begin[k + 1]);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  bundle.inputs = size_of(members);
  bundle.width = (size_of(all) + P::lanes - 1) / P::lanes;
  bundle.C.assign(members.size() * static_cast<std::size_t>(bundle.width), P(0));
  for (int i = 0; i < bundle.inputs; ++i)
    for (int n = inputs.begin[members[i]]; n < inputs.begin[members[i] + 1]; ++n) {
      const auto at = std::lower_bound(all.begin(), all.end(), inputs.variable[n]);
      bundle.c(i, static_cast<int>(at - all.begin())) = inputs.coefficient[n];
    }
  bundles_.push_back(std::move(bundle));
}

void HessianChain::add(int left, int right, int source) {
  int l = bundle_of_[left - first_input_], r = bundle_of_[right - first_input_];
  if (l < 0 || r < 0) return;
  // The rows of the result are those of later variables, as far as there is a choice.
  if (bundles_[l].variables[0] < bundles_[r].variables[0]) {
    std::swap(l, r);
    std::swap(left, right);
  }
  const auto count = static_cast<std::size_t>(static_cast<int>(bundles_.size()) - first_bundle_);
  int& draft = draft_of_[static_cast<std::size_t>(l - first_bundle_) * count +
                         static_cast<std::size_t>(r - first_bundle_)];
  if (draft < 0) {
    draft = static_cast<int>(drafts_.size());
    drafts_.push_back({l, r, {}, {}});
  }
  const int i = place_of_[left - first_input_], k = place_of_[right - first_input_];
  const int columns = bundles_[r].inputs;
  drafts_[draft].entries.push_back(
      {i * columns + k, l == r && i != k ? k * columns + i : -1, source});
}

/// Of one bundle with itself only the lower triangle.
std::vector<std::pair<int, int>> HessianChain::pairs_of(const Draft& draft) {
  Bundle &left = bundles_[draft.left], &right = bundles_[draft.right];
  const int m = size_of(left.variables), n = size_of(right.variables);
  std::vector<char> reached(static_cast<std::size_t>(m) * static_cast<std::size_t>(n), 0);
  for (const Entry& e : draft.entries)
    for (const int at : {e.at, e.mirror})
      for (int a = 0; at >= 0 && a < m; ++a)
        for (int b = 0; b < n && left.c(at / right.inputs, a) != 0; ++b)
          if (right.c(at % right.inputs, b) != 0) reached[a * n + b] = 1;
  std::vector<std::pair<int, int>> pairs;
  for (int a = 0; a < m; ++a)
    for (int b = 0; b < (draft.left == draft.right ? a + 1 : n); ++b)
      if (reached[a * n + b]) pairs.emplace_back(a, b);
  return pairs;
}

void HessianChain::list(LowerTriangle& triangle) {
  for (Draft& draft : drafts_) {
    draft.pairs = pairs_of(draft);
    for (const auto& [a, b] : draft.pairs)
      triangle.add(bundles_[draft.left].variables[a], bundles_[draft.right].variables[b]);
  }
}

void HessianChain::lay_out(const LowerTriangle& triangle) {
  const auto first_target = [&](const Draft& d) {
    return triangle.entry(bundles_[d.left].variables[d.pairs[0].first],
                          bundles_[d.right].variables[d.pairs[0].second]);
  };
  std::vector<std::pair<int, int>> order;
  order.reserve(drafts_.size());
  for (int k = 0; k < static_cast<int>(drafts_.size()); ++k)
    order.emplace_back(first_target(drafts_[k]), k);
  std::sort(order.begin(), order.end());
  for (const auto& [at, k] : order) {
    const Draft& draft = drafts_[k];
    const Bundle &left = bundles_[draft.left], &right = bundles_[draft.right];
    const int first_run = static_cast<int>(runs_.size());
    for (const auto& [a, b] : draft.pairs) {
      const int target = triangle.entry(left.variables[a], right.variables[b]);
      const int from = a * P::lanes * right.width + b;
      const bool more = static_cast<int>(runs_.size()) > first_run &&
                        target == runs_.back().target + runs_.back().count &&
                        from == runs_.back().from + runs_.back().count;
      if (more)
        ++runs_.back().count;
      else
        runs_.push_back({target, from, 1});
    }
    entries_.insert(entries_.end(), draft.entries.begin(), draft.entries.end());
    blocks_.push_back({draft.left, draft.right, static_cast<int>(entries_.size()),
                       static_cast<int>(runs_.size())});
  }
  drafts_ = {};
  share_out(1);
}

void HessianChain::share_out(int members) {
  std::vector<int> low, high;
  int k = 0;
  for (const Block& block : blocks_) {
    low.push_back(std::numeric_limits<int>::max());
    high.push_back(-1);
    for (; k < block.run; ++k) {
      low.back() = std::min(low.back(), runs_[k].target);
      high.back() = std::max(high.back(), runs_[k].target + runs_[k].count - 1);
    }
  }
  parts_ = parts_of(low, high, members);
  scratch_.resize(static_cast<std::size_t>(members));
}

/// product = C_left^T W C_right.
void HessianChain::contract(const Block& block, int first_entry, const double* source,
                            Scratch& s) const {
  const Bundle &left = bundles_[block.left], &right = bundles_[block.right];
  const int m = size_of(left.variables), width = right.width, columns = right.inputs;
  s.W.assign(static_cast<std::size_t>(left.inputs) * static_cast<std::size_t>(columns), 0);
  s.row.resize(static_cast<std::size_t>(width));
  s.product.assign(static_cast<std::size_t>(m) * static_cast<std::size_t>(width), P(0));
  for (int k = first_entry; k < block.entry; ++k) {
    const Entry& e = entries_[k];
    s.W[e.at] += source[e.source];
    if (e.mirror >= 0) s.W[e.mirror] += source[e.source];
  }
  P* const row = s.row.data();
  for (int i = 0; i < left.inputs; ++i) {
    std::fill(s.row.begin(), s.row.end(), P(0));
    for (int k = 0; k < columns; ++k) {
      const double w = s.W[i * columns + k];
      if (w == 0) continue;
      for (int b = 0; b < width; ++b) row[b] = row[b] + P(w) * right.C[k * width + b];
    }
    const double* c = reinterpret_cast<const double*>(left.C.data() + i * left.width);
    for (int a = 0; a < m; ++a) {
      P* const to = s.product.data() + a * width;
      for (int b = 0; b < width; ++b) to[b] = to[b] + P(c[a]) * row[b];
    }
  }
}

void HessianChain::run(int member, const double* source, double* target) {
  Scratch& scratch = scratch_[member];
  for (int k = parts_[member]; k < parts_[member + 1]; ++k) {
    contract(blocks_[k], k == 0 ? 0 : blocks_[k - 1].entry, source, scratch);
    const double* from = reinterpret_cast<const double*>(scratch.product.data());
    for (int n = k == 0 ? 0 : blocks_[k - 1].run; n < blocks_[k].run; ++n) {
      const Run& r = runs_[n];
      for (int c = 0; c < r.count; ++c) target[r.target + c] += from[r.from + c];
    }
  }
}

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

// Builder: lists of operands, and what crosses between scalars and lanes.
#include <algorithm>

#include "graph/builder.h"

namespace arboc {

Ref Builder::listed(Op op, const std::vector<Term>& terms) {
  Node node;
  node.op = op;
  node.index = static_cast<std::uint32_t>(region_.terms.size());
  node.count = static_cast<std::uint32_t>(terms.size());
  region_.terms.insert(region_.terms.end(), terms.begin(), terms.end());
  const size_t nodes = region_.nodes.size();
  const Ref ref = intern(node);
  if (nodes == region_.nodes.size()) region_.terms.resize(node.index);  // known already
  return ref;
}

Ref Builder::sum(const std::vector<Term>& terms) { return listed(Op::kSum, terms); }

Ref Builder::pack(const std::vector<Ref>& scalars) {
  const auto all = [&](auto holds) { return std::all_of(scalars.begin(), scalars.end(), holds); };
  const Ref first = scalars[0];
  if (all([&](Ref x) { return x == first; })) return first;
  if (all([&](Ref x) { return region_.is_constant(x); })) {
    Lanes lanes;
    lanes.width = 0;
    for (const Ref x : scalars) lanes.x[lanes.width++] = region_.value(x);
    return constant(lanes);
  }
  std::vector<Term> terms;
  for (const Ref x : scalars) terms.push_back({x, Ref(), false});
  return listed(Op::kPack, terms);
}

Ref Builder::lane(Ref a, int k) {
  const Node& node = region_[a];
  if (node.width == 1) return a;
  if (node.op == Op::kConstant) return constant(region_.lanes(a)[k]);
  if (node.op == Op::kPack)
    return region_.terms[node.index + static_cast<size_t>(k)].a.with_sign_of(a);
  const Ref ref = unary(Op::kLane, a.positive(), k);
  return a.negative() ? -ref : ref;
}

Ref Builder::hsum(Ref a, int n) {
  if (region_[a].width == 1) return mul(constant(n), a);
  if (region_.is_constant(a)) {
    const Lanes lanes = region_.lanes(a);
    double sum = 0;
    for (int k = 0; k < n; ++k) sum += lanes[k];
    return constant(sum);
  }
  const Ref ref = unary(Op::kHsum, a.positive(), n);
  return a.negative() ? -ref : ref;
}

/// hsum(x) + hsum(y), and (u + hsum(x)) + hsum(y) for either operand of the inner sum.
Ref Builder::fold_hsum(Ref a, Ref b, bool& found) {
  const Node y = region_[b];
  if (y.op != Op::kHsum) return a;
  const auto fits = [&](Ref r) {
    const Node& x = region_[r];
    return x.op == Op::kHsum && x.index == y.index && region_[x.a].width == region_[y.a].width;
  };
  const auto merged = [&](Ref r) {
    const Ref x = region_[r].a.with_sign_of(r);
    return hsum(add(x, y.a.with_sign_of(b)), static_cast<int>(y.index));
  };
  found = true;
  if (fits(a)) return merged(a);
  const Node sum = region_[a];
  if (sum.op == Op::kAdd && fits(sum.b))
    return add(sum.a.with_sign_of(a), merged(sum.b.with_sign_of(a)));
  if (sum.op == Op::kAdd && fits(sum.a))
    return add(sum.b.with_sign_of(a), merged(sum.a.with_sign_of(a)));
  found = false;
  return a;
}

}  // namespace arboc

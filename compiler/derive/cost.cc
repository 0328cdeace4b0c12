#include "derive/cost.h"

#include "derive/rules.h"

namespace arboc {

int estimated_cost(const Region& region, const std::vector<Ref>& roots) {
  enum : unsigned char { kNeeded = 1, kInAdd = 2, kInAdds = 4, kElsewhere = 8, kAtom = 16 };
  std::vector<unsigned char> use(end_of(roots), 0);
  for (const Ref root : roots) use[root.node()] |= kNeeded | kElsewhere;
  for (size_t n = use.size(); n-- > 0;) {
    if (!(use[n] & kNeeded)) continue;
    const Node& node = region.nodes[n];
    for_each_operand(region, node, [&](Ref operand) {
      unsigned char& u = use[operand.node()];
      u |= kNeeded;
      u |= node.op != Op::kAdd ? kElsewhere : u & kInAdd ? kInAdds : kInAdd;
    });
  }
  // A sum costs its additions, and one more if it begins with a product.
  int cost = 0;
  for (size_t n = 0; n < use.size(); ++n) {
    if (!(use[n] & kNeeded)) continue;
    const Node& node = region.nodes[n];
    if (node.op == Op::kDiv || node.op == Op::kSqrt) ++cost;
    if (node.op == Op::kMul && use[n] & kElsewhere) ++cost;
    if (node.op != Op::kAdd) continue;
    for_each_operand(region, node, [&](Ref operand) {
      const unsigned char u = use[operand.node()];
      const Op op = region[operand].op;
      const bool term = op == Op::kMul && !(u & kElsewhere);
      const bool joins = op == Op::kAdd && !(u & (kElsewhere | kInAdds));
      if (!term && (!joins || u & kAtom)) use[n] |= kAtom;
    });
    const bool root = use[n] & (kElsewhere | kInAdds);
    cost += root && !(use[n] & kAtom) ? 2 : 1;
  }
  return cost;
}

}  // namespace arboc

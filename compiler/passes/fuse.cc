// fuse(): the rules, applied to each sum.
//
//   1. An addition with one user that is an addition too joins its user; the others are roots:
//      lists of signed terms, atoms x or products a b.
//   2. A product used by sums only is never computed by itself, also when several sums use it: a
//      fused multiply-add costs what the addition would.
//   3. A root of nothing but shared products needs one plain product to start with; that one
//      becomes an atom of all its sums.
//   4. Sums and products do not join sums of another width: a scalar is broadcast once.
//   5. The constants of a root are one, and a term and its opposite are none.
#include "passes/fuse.h"

#include <algorithm>
#include <stdexcept>

#include "graph/builder.h"
#include "graph/remake.h"
#include "passes/rewrite.h"

namespace arboc {
namespace {

class Fuser {
 public:
  explicit Fuser(const Region& region)
      : in_(region),
        live_(alive(region)),
        uses_(count_uses(region)),
        atom_(region.nodes.size(), 0),
        depth_(region.nodes.size(), 0),
        sums_(region.nodes.size()),
        out_(region.nodes.size()),
        builder_(region.name) {}

  Graph run() {
    for (size_t n = 0; n < in_.nodes.size(); ++n)
      if (is_root(n)) sums_[n] = flatten(Ref(static_cast<std::uint32_t>(n)));
    for (size_t n = 0; n < in_.nodes.size(); ++n)
      if (is_root(n)) choose_starter(sums_[n]);
    declare_inputs();
    for (size_t n = 0; n < in_.nodes.size(); ++n) rebuild(n);
    for (size_t p = 0; p < in_.outputs.size(); ++p) {
      std::vector<Ref> entries;
      for (const Ref ref : in_.results[p]) entries.push_back(renamed(ref));
      builder_.output(in_.outputs[p].name, entries);
    }
    return std::move(builder_).finish();
  }

 private:
  bool is_sum(size_t n) const { return live_[n] && in_.nodes[n].op == Op::kAdd; }
  bool joins_user(size_t n) const {
    return is_sum(n) && uses_.in_sums[n] == 1 && uses_.elsewhere[n] == 0;
  }
  bool is_root(size_t n) const { return is_sum(n) && !joins_user(n); }
  bool is_term(size_t n) const {  // rule 2
    return live_[n] && in_.nodes[n].op == Op::kMul && uses_.elsewhere[n] == 0 && !atom_[n];
  }

  /// The signed terms of a root, left to right; products as references to their nodes.
  std::vector<Ref> flatten(Ref root) const {
    std::vector<Ref> terms, stack;
    const auto push = [&](Ref ref) {
      const Node& node = in_[ref];
      stack.push_back(node.b.with_sign_of(ref));
      stack.push_back(node.a.with_sign_of(ref));
    };
    push(root);
    while (!stack.empty()) {
      const Ref ref = stack.back();
      stack.pop_back();
      if (joins_user(ref.node()))
        push(ref);
      else
        terms.push_back(ref);
    }
    return terms;
  }

  void choose_starter(const std::vector<Ref>& terms) {
    const Ref* best = nullptr;
    for (const Ref& term : terms) {
      if (!is_term(term.node()) || uses_.in_sums[term.node()] == 1) return;
      const auto rank = [&](Ref r) {
        return uses_.in_sums[r.node()] + (r.negative() ? 0 : 1 << 20);
      };
      if (!best || rank(term) > rank(*best)) best = &term;
    }
    if (best) atom_[best->node()] = 1;
  }

  void declare_inputs() {
    std::vector<Ref> all;
    for (const Port& port : in_.inputs) {
      const auto refs = builder_.input(port.name, port.size);
      all.insert(all.end(), refs.begin(), refs.end());
    }
    for (size_t n = 0; n < in_.nodes.size(); ++n)
      if (in_.nodes[n].op == Op::kInput) out_[n] = all[in_.nodes[n].index];
  }

  Ref renamed(Ref old) const { return out_[old.node()].with_sign_of(old); }

  void rebuild(size_t n) {
    const Node& node = in_.nodes[n];
    if (!live_[n] || joins_user(n) || node.op == Op::kInput) return;
    builder_.begin_block(in_.blocks[node.block]);
    for_each_operand(in_, node,
                     [&](Ref r) { depth_[n] = std::max(depth_[n], depth_[r.node()] + 1); });
    if (node.op == Op::kAdd)
      out_[n] = rebuild_sum(n);
    else if (node.op != Op::kMul || !is_term(n))
      out_[n] =
          remake(builder_, in_, static_cast<std::uint32_t>(n), [&](Ref r) { return renamed(r); });
  }

  struct Sorted {
    Term term;
    int depth;
  };

  /// Rules 1 and 5.
  std::vector<Sorted> terms_of(size_t n) {
    std::vector<Sorted> terms;
    Ref constant = builder_.constant(0);
    depth_[n] = 0;
    for (const Ref old : sums_[n]) {
      const Node& node = in_[old];
      if (node.op == Op::kConstant) {
        constant = builder_.add(constant, renamed(old));
        continue;
      }
      Sorted item{{renamed(old), Ref(), false}, depth_[old.node()]};
      if (is_term(old.node())) {
        const Ref a = renamed(node.a), b = renamed(node.b);
        item.term = {a.with_sign_of(b).with_sign_of(old), b.positive(), true};
      }
      depth_[n] = std::max(depth_[n], item.depth + 1);
      const auto opposite = std::find_if(terms.begin(), terms.end(), [&](const Sorted& x) {
        return x.term.a == -item.term.a && x.term.product == item.term.product &&
               x.term.b == item.term.b;
      });
      if (opposite == terms.end())
        terms.push_back(item);
      else
        terms.erase(opposite);
    }
    if (!(constant.positive() == builder_.constant(0)))
      terms.insert(terms.begin(), {{constant, Ref(), false}, 0});
    return terms;
  }

  Ref rebuild_sum(size_t n) {
    std::vector<Sorted> terms = terms_of(n);
    if (terms.empty()) return builder_.constant(0);
    if (terms.size() == 1) {
      const Term& only = terms[0].term;
      return only.product ? builder_.mul(only.a, only.b) : only.a;
    }
    std::stable_sort(terms.begin(), terms.end(), [](const Sorted& x, const Sorted& y) {
      if (x.term.product != y.term.product) return y.term.product;
      return x.depth < y.depth;
    });
    const auto positive = [](const Sorted& x) { return !x.term.a.negative(); };
    const bool flip =
        uses_.minus_outputs[n] > 0 || std::none_of(terms.begin(), terms.end(), positive);
    if (flip)
      for (Sorted& item : terms) item.term.a = -item.term.a;
    const auto first = std::find_if(terms.begin(), terms.end(), positive);
    if (first != terms.end()) std::rotate(terms.begin(), first, first + 1);

    std::vector<Term> list;
    for (const Sorted& item : terms) list.push_back(item.term);
    const Ref sum = builder_.sum(list);
    return flip ? -sum : sum;
  }

  const Region& in_;
  std::vector<char> live_;
  Uses uses_;
  std::vector<char> atom_;              ///< products that rule 3 computes by themselves
  std::vector<int> depth_;              ///< longest path from the inputs
  std::vector<std::vector<Ref>> sums_;  ///< terms of the roots
  std::vector<Ref> out_;                ///< old node -> new reference
  Builder builder_;
};

}  // namespace

Graph fuse(const Graph& graph) {
  Graph out;
  for (const Region& region : graph.regions)
    out.regions.push_back(std::move(Fuser(region).run().regions[0]));
  return out;
}

}  // namespace arboc

#include "graph/canonical.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "graph/remake.h"

namespace arboc {
namespace {

/// The labels, and the nodes in their order.
class Labels {
 public:
  Labels(const Builder& builder, const std::vector<Ref>& roots)
      : builder_(builder),
        in_(builder.region()),
        live_(in_.nodes.size(), 0),
        level_(in_.nodes.size(), 0),
        label_(in_.nodes.size(), 0),
        flip_(in_.nodes.size(), 0) {
    for (const Ref root : roots) live_[root.node()] = 1;
    for (size_t n = in_.nodes.size(); n-- > 0;)
      if (live_[n]) for_each_operand(in_, in_.nodes[n], [&](Ref r) { live_[r.node()] = 1; });
    label_leaves();
    const auto place = [&](std::uint32_t n) { return std::pair(builder_.step(n), level_[n]); };
    std::sort(order_.begin(), order_.end(), [&](auto x, auto y) { return place(x) < place(y); });
    for (size_t first = 0, last = 0; first < order_.size(); first = last) {
      while (last < order_.size() && place(order_[last]) == place(order_[first])) ++last;
      label_level(first, last);
    }
  }

  bool is_leaf(std::uint32_t n) const {
    return in_.nodes[n].op == Op::kConstant || in_.nodes[n].op == Op::kInput;
  }
  std::uint32_t operator[](std::uint32_t n) const { return label_[n]; }
  /// Live nodes but the leaves.
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  using Key = std::vector<std::uint64_t>;

  /// Inputs, then constants by value.
  void label_leaves() {
    std::vector<std::uint32_t> constants;
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n) {
      const Node& node = in_.nodes[n];
      if (node.op == Op::kInput) label_[n] = next_++;
      if (node.op == Op::kConstant) constants.push_back(n);
      if (!live_[n] || is_leaf(n)) continue;
      order_.push_back(n);
      for_each_operand(in_, node, [&](Ref r) {
        if (!is_leaf(r.node()) && builder_.step(r.node()) == builder_.step(n))
          level_[n] = std::max(level_[n], level_[r.node()] + 1);
      });
    }
    const auto values = [&](std::uint32_t n) {
      const double* first = in_.constants.data() + in_.nodes[n].index;
      return std::vector<double>(first, first + in_.nodes[n].count);
    };
    std::sort(constants.begin(), constants.end(),
              [&](auto x, auto y) { return values(x) < values(y); });
    for (const std::uint32_t n : constants) label_[n] = next_++;
  }

  void label_level(size_t first, size_t last) {
    std::vector<std::pair<Key, std::uint32_t>> keyed;
    for (size_t i = first; i < last; ++i) keyed.emplace_back(key(order_[i]), order_[i]);
    std::sort(keyed.begin(), keyed.end());
    for (const auto& [k, n] : keyed) {
      order_[first++] = n;
      label_[n] = next_++;
    }
  }

  /// Operation and operands.  The node stands for what the key says or, if flip_, for minus that:
  /// which of a - b and b - a it is follows from the order in which it was made.
  Key key(std::uint32_t n) {
    const Node& node = in_.nodes[n];
    const auto code = [&](Ref r) {
      const bool minus = r.negative() != (flip_[r.node()] != 0);
      return 2 * std::uint64_t{label_[r.node()]} + (minus ? 1 : 0);
    };
    const int operands = operand_count(node.op);
    std::uint64_t a = operands > 0 ? code(node.a) : 0, b = operands > 1 ? code(node.b) : 0;
    std::uint64_t minus = 0;
    if (a > b && (node.op == Op::kAdd || node.op == Op::kMul)) std::swap(a, b);
    Key key{static_cast<std::uint64_t>(node.op)};
    switch (node.op) {
      case Op::kAdd:
        minus = a & 1;
        b ^= minus;
        break;
      case Op::kMul:
      case Op::kDiv:
        minus = (a ^ b) & 1;
        b &= ~std::uint64_t{1};
        break;
      case Op::kSin:
      case Op::kLane:
      case Op::kHsum:
      case Op::kQuaternionLog: minus = a & 1; break;
      case Op::kPack:
        for_each_operand(in_, node, [&](Ref r) { key.push_back(code(r)); });
        return key;
      default: break;
    }
    const bool free_sign = node.op != Op::kSqrt && node.op != Op::kStumpff;
    if (free_sign) a &= ~std::uint64_t{1};
    flip_[n] = static_cast<char>(minus);
    key.insert(key.end(), {a, b, node.index});
    return key;
  }

  const Builder& builder_;
  const Region& in_;
  std::vector<char> live_;
  std::vector<int> level_;
  std::vector<std::uint32_t> label_;
  std::vector<char> flip_;
  std::vector<std::uint32_t> order_;
  std::uint32_t next_ = 0;
};

/// Makes the nodes again.
class Rebuilder {
 public:
  Rebuilder(const Builder& old, const Labels& labels)
      : old_(old),
        in_(old.region()),
        labels_(labels),
        done_(in_.nodes.size(), 0),
        out_(in_.nodes.size()),
        builder_(in_.name) {
    std::vector<Ref> inputs;
    for (const Port& port : in_.inputs)
      for (const Ref ref : builder_.input(port.name, port.size)) inputs.push_back(ref);
    for (size_t n = 0; n < in_.nodes.size(); ++n)
      if (in_.nodes[n].op == Op::kInput) out_[n] = inputs[in_.nodes[n].index];
  }

  void by_levels() {
    for (const std::uint32_t n : labels_.order()) rebuild(n);
  }

  /// Tips, which their own step does not use, and in front of each what it needs.
  void by_cones() {
    std::vector<char> used(in_.nodes.size(), 0);
    for (const std::uint32_t n : labels_.order())
      for_each_operand(in_, in_.nodes[n], [&](Ref r) {
        if (old_.step(r.node()) == old_.step(n)) used[r.node()] = 1;
      });
    for (const std::uint32_t n : labels_.order())
      if (!used[n]) cone(n);
  }

  Ref renamed(Ref old) {
    if (in_.is_constant(old)) return builder_.constant(in_.lanes(old));
    return out_[old.node()].with_sign_of(old);
  }
  Builder take() && { return std::move(builder_); }

 private:
  void cone(std::uint32_t tip) {
    std::vector<std::uint32_t> stack{tip}, needs;
    while (!stack.empty()) {
      const std::uint32_t n = stack.back();
      needs.clear();
      if (!done_[n])
        for_each_operand(in_, in_.nodes[n], [&](Ref r) {
          if (!done_[r.node()] && !labels_.is_leaf(r.node())) needs.push_back(r.node());
        });
      if (needs.empty()) {
        stack.pop_back();
        if (!done_[n]) rebuild(n);
      }
      std::sort(needs.begin(), needs.end(),
                [&](auto x, auto y) { return labels_[x] > labels_[y]; });
      stack.insert(stack.end(), needs.begin(), needs.end());
    }
  }

  void rebuild(std::uint32_t n) {
    const Node& node = in_.nodes[n];
    builder_.begin_block(in_.blocks[node.block]);
    done_[n] = 1;
    if (node.op != Op::kConstant && node.op != Op::kInput)
      out_[n] = remake(builder_, in_, n, [&](Ref r) { return renamed(r); });
  }

  const Builder& old_;
  const Region& in_;
  const Labels& labels_;
  std::vector<char> done_;
  std::vector<Ref> out_;  ///< old node -> new reference
  Builder builder_;
};

}  // namespace

std::vector<Ref> canonicalise(Builder& builder, const std::vector<Ref>& roots, NodeOrder order) {
  const Labels labels(builder, roots);
  Rebuilder rebuilder(builder, labels);
  if (order == NodeOrder::kByLevels)
    rebuilder.by_levels();
  else
    rebuilder.by_cones();
  std::vector<Ref> renamed;
  for (const Ref root : roots) renamed.push_back(rebuilder.renamed(root));
  builder = std::move(rebuilder).take();
  return renamed;
}

void canonicalise(Builder& builder, const std::vector<Expr*>& roots, NodeOrder order) {
  std::vector<Ref> refs;
  for (const Expr* x : roots) refs.push_back(x->ref(builder));
  refs = canonicalise(builder, refs, order);
  for (size_t k = 0; k < roots.size(); ++k) *roots[k] = Expr(&builder, refs[k]);
}

}  // namespace arboc

#include "graph/builder.h"

#include <bit>
#include <cmath>
#include <utility>

namespace arboc {

Builder::Builder(std::string name) : table_(1024) { region_.name = std::move(name); }

std::vector<Ref> Builder::input(const std::string& name, int size) {
  region_.inputs.push_back({name, size, 1});
  std::vector<Ref> refs;
  for (int i = 0; i < size; ++i) {
    Node node;
    node.op = Op::kInput;
    node.index = next_input_++;
    refs.push_back(intern(node));
  }
  return refs;
}

void Builder::output(const std::string& name, const std::vector<Ref>& entries) {
  region_.outputs.push_back({name, static_cast<int>(entries.size()), 1});
  region_.results.push_back(entries);
}

void Builder::begin_block(const std::string& title) {
  if (region_.blocks[block_] == title) return;
  if (region_.blocks.size() > 0xFFFE) return;  // the rest joins the last block
  region_.blocks.push_back(title);
  block_ = static_cast<std::uint16_t>(region_.blocks.size() - 1);
}

size_t Builder::hash(const Node& node) const {
  const auto mix = [](std::uint64_t h, std::uint64_t x) {
    h = (h ^ x) * 0x9E3779B97F4A7C15u;
    return h ^ (h >> 29);
  };
  std::uint64_t h = mix(static_cast<std::uint64_t>(node.op), node.a.bits());
  h = mix(h, node.b.bits());
  if (node.op == Op::kConstant)
    return mix(h, std::bit_cast<std::uint64_t>(region_.constants[node.index]));
  if (node.op != Op::kSum) return mix(h, node.index);
  for (std::uint32_t t = node.index; t < node.index + node.count; ++t) {
    const Term& term = region_.terms[t];
    h = mix(mix(h, term.a.bits()), term.product ? term.b.bits() + 1ull : 0ull);
  }
  return h;
}

bool Builder::same(const Node& x, const Node& y) const {
  if (x.op != y.op || !(x.a == y.a) || !(x.b == y.b) || x.count != y.count) return false;
  if (x.op == Op::kConstant) return region_.constants[x.index] == region_.constants[y.index];
  if (x.op != Op::kSum) return x.index == y.index;
  for (std::uint32_t i = 0; i < x.count; ++i) {
    const Term& s = region_.terms[x.index + i];
    const Term& t = region_.terms[y.index + i];
    if (!(s.a == t.a) || s.product != t.product || (s.product && !(s.b == t.b))) return false;
  }
  return true;
}

void Builder::grow() {
  table_.assign(table_.size() * 2, 0);
  for (std::uint32_t n = 0; n < region_.nodes.size(); ++n) {
    size_t slot = hash(region_.nodes[n]) & (table_.size() - 1);
    while (table_[slot] != 0) slot = (slot + 1) & (table_.size() - 1);
    table_[slot] = n + 1;
  }
}

Ref Builder::intern(const Node& node) {
  if (2 * (used_ + 1) > table_.size()) grow();
  size_t slot = hash(node) & (table_.size() - 1);
  for (; table_[slot] != 0; slot = (slot + 1) & (table_.size() - 1))
    if (same(region_.nodes[table_[slot] - 1], node)) return Ref(table_[slot] - 1);
  region_.nodes.push_back(node);
  region_.nodes.back().block = block_;
  table_[slot] = static_cast<std::uint32_t>(region_.nodes.size());
  ++used_;
  return Ref(table_[slot] - 1);
}

Ref Builder::constant(double value) {
  Node node;
  node.op = Op::kConstant;
  node.index = static_cast<std::uint32_t>(region_.constants.size());
  node.count = 1;
  region_.constants.push_back(std::fabs(value));
  const size_t nodes = region_.nodes.size();
  const Ref ref = intern(node);
  if (nodes == region_.nodes.size()) region_.constants.pop_back();  // known already
  return std::signbit(value) && value != 0 ? -ref : ref;
}

double Builder::split_factor(Ref& x) const {
  const double sign = x.negative() ? -1.0 : 1.0;
  x = x.positive();
  const Node& node = region_[x];
  if (node.op != Op::kMul || !region_.is_constant(node.a)) return sign;
  const double factor = sign * region_.value(node.a);
  x = node.b;
  return factor;
}

/// (u + x) - x = u, for either operand of the inner sum.
Ref Builder::fold_nested_add(Ref sum, Ref x, bool& found) {
  const Node& node = region_[sum];
  if (node.op != Op::kAdd) return sum;
  const Ref a = node.a.with_sign_of(sum), b = node.b.with_sign_of(sum);
  found = a == -x || b == -x;
  return a == -x ? b : a;
}

Ref Builder::add(Ref a, Ref b) {
  if (region_.is_constant(b)) std::swap(a, b);
  if (region_.is_constant(a)) {
    const double value = region_.value(a);
    if (value == 0) return b;
    if (region_.is_constant(b)) return constant(value + region_.value(b));
    Node inner = region_[b];
    if (inner.op == Op::kAdd) {
      if (region_.is_constant(inner.b)) std::swap(inner.a, inner.b);
      if (region_.is_constant(inner.a))
        return add(constant(value + region_.value(inner.a.with_sign_of(b))),
                   inner.b.with_sign_of(b));
    }
  }
  Ref x = a, y = b;
  const double p = split_factor(x), r = split_factor(y);
  if (x == y) return mul(constant(p + r), x);
  bool found = false;
  if (const Ref u = fold_nested_add(a, b, found); found) return u;
  if (const Ref u = fold_nested_add(b, a, found); found) return u;

  // Canonical: the lower node first and positive, the sign outside.
  if (a.node() > b.node()) std::swap(a, b);
  const bool negative = a.negative();
  Node node;
  node.op = Op::kAdd;
  node.a = a.positive();
  node.b = negative ? -b : b;
  const Ref ref = intern(node);
  return negative ? -ref : ref;
}

Ref Builder::mul(Ref a, Ref b) {
  if (region_.is_constant(b)) std::swap(a, b);
  const bool negative = a.negative() != b.negative();
  a = a.positive();
  b = b.positive();
  const auto signed_result = [&](Ref r) { return negative ? -r : r; };
  if (region_.is_constant(a)) {
    const double value = region_.value(a);
    if (value == 0) return a;
    if (value == 1) return signed_result(b);
    if (region_.is_constant(b)) return signed_result(constant(value * region_.value(b)));
    const Node inner = region_[b];
    if (inner.op == Op::kMul && region_.is_constant(inner.a))
      return signed_result(mul(constant(value * region_.value(inner.a)), inner.b));
  } else if (a.node() > b.node()) {
    std::swap(a, b);
  }
  Node node;
  node.op = Op::kMul;
  node.a = a;
  node.b = b;
  return signed_result(intern(node));
}

Ref Builder::div(Ref a, Ref b) {
  const bool negative = a.negative() != b.negative();
  a = a.positive();
  b = b.positive();
  const auto signed_result = [&](Ref r) { return negative ? -r : r; };
  if (region_.is_constant(a) && region_.value(a) == 0) return a;
  if (a == b) return signed_result(constant(1.0));
  if (region_.is_constant(b) && region_.value(b) != 0) {
    const double divisor = region_.value(b);
    if (region_.is_constant(a)) return signed_result(constant(region_.value(a) / divisor));
    return signed_result(mul(constant(1.0 / divisor), a));
  }
  Node node;
  node.op = Op::kDiv;
  node.a = a;
  node.b = b;
  return signed_result(intern(node));
}

Ref Builder::unary(Op op, Ref a, int index) {
  Node node;
  node.op = op;
  node.a = a;
  node.index = static_cast<std::uint32_t>(index);
  return intern(node);
}

Ref Builder::sqrt(Ref a) {
  if (region_.is_constant(a) && region_.value(a) >= 0) return constant(std::sqrt(region_.value(a)));
  return unary(Op::kSqrt, a);
}

Ref Builder::sin(Ref a) {
  if (region_.is_constant(a) && region_.value(a) == 0) return a.positive();
  const Ref ref = unary(Op::kSin, a.positive());
  return a.negative() ? -ref : ref;
}

Ref Builder::cos(Ref a) {
  if (region_.is_constant(a) && region_.value(a) == 0) return constant(1.0);
  return unary(Op::kCos, a.positive());
}

Ref Builder::stumpff(int k, Ref x) {
  if (region_.is_constant(x) && region_.value(x) == 0)
    return constant(special_value(Op::kStumpff, k, 0));
  return unary(Op::kStumpff, x, k);
}

Ref Builder::quaternion_log(Ref w) {
  const bool one = region_.is_constant(w) && region_.value(w.positive()) == 1;
  const Ref ref = one ? constant(2.0) : unary(Op::kQuaternionLog, w.positive());
  return w.negative() ? -ref : ref;
}

Ref Builder::log_curvature(Ref w) {
  if (region_.is_constant(w) && region_.value(w.positive()) == 1) return constant(1.0 / 12);
  return unary(Op::kLogCurvature, w.positive());
}

Ref Builder::sum(const std::vector<Term>& terms) {
  Node node;
  node.op = Op::kSum;
  node.index = static_cast<std::uint32_t>(region_.terms.size());
  node.count = static_cast<std::uint32_t>(terms.size());
  region_.terms.insert(region_.terms.end(), terms.begin(), terms.end());
  const size_t nodes = region_.nodes.size();
  const Ref ref = intern(node);
  if (nodes == region_.nodes.size()) region_.terms.resize(node.index);
  return ref;
}

Graph Builder::finish() && {
  Graph graph;
  graph.regions.push_back(std::move(region_));
  return graph;
}

}  // namespace arboc

#include "graph/builder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

namespace arboc {
namespace {

constexpr Lanes one{1, {1.0}};

template <class Operation>
Lanes each_lane(const Lanes& a, const Lanes& b, Operation operation) {
  Lanes result;
  result.width = std::max(a.width, b.width);
  for (int k = 0; k < result.width; ++k) result.x[k] = operation(a[k], b[k]);
  return result;
}
Lanes operator+(const Lanes& a, const Lanes& b) { return each_lane(a, b, std::plus<>()); }
Lanes operator*(const Lanes& a, const Lanes& b) { return each_lane(a, b, std::multiplies<>()); }
Lanes operator/(const Lanes& a, const Lanes& b) { return each_lane(a, b, std::divides<>()); }
bool has_zero(const Lanes& a) { return std::count(a.x, a.x + a.width, 0.0) > 0; }

}  // namespace

Builder::Builder(std::string name) : table_(1024) { region_.name = std::move(name); }

std::vector<Ref> Builder::input(const std::string& name, int size) {
  region_.inputs.push_back({name, size});
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
  region_.outputs.push_back({name, static_cast<int>(entries.size())});
  region_.results.push_back(entries);
}

void Builder::begin_block(const std::string& title) {
  next_step();
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
  if (node.op == Op::kConstant) {
    for (std::uint32_t k = node.index; k < node.index + node.count; ++k)
      h = mix(h, std::bit_cast<std::uint64_t>(region_.constants[k]));
    return h;
  }
  if (node.op != Op::kSum && node.op != Op::kPack) return mix(h, node.index);
  for (std::uint32_t t = node.index; t < node.index + node.count; ++t) {
    const Term& term = region_.terms[t];
    h = mix(mix(h, term.a.bits()), term.product ? term.b.bits() + 1ull : 0ull);
  }
  return h;
}

bool Builder::same(const Node& x, const Node& y) const {
  if (x.op != y.op || !(x.a == y.a) || !(x.b == y.b) || x.count != y.count) return false;
  if (x.op == Op::kConstant) {
    const double* c = region_.constants.data();
    return std::equal(c + x.index, c + x.index + x.count, c + y.index);
  }
  if (x.op != Op::kSum && x.op != Op::kPack) return x.index == y.index;
  return same_terms(x, y);
}

bool Builder::same_terms(const Node& x, const Node& y) const {
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
  const int width = width_of(region_, node);
  if (width == 0) throw std::logic_error("operands of different widths");
  region_.nodes.push_back(node);
  region_.nodes.back().block = block_;
  region_.nodes.back().width = static_cast<std::uint8_t>(width);
  steps_.push_back(step_);
  table_[slot] = static_cast<std::uint32_t>(region_.nodes.size());
  ++used_;
  return Ref(table_[slot] - 1);
}

Ref Builder::constant(double value) {
  Lanes lanes;
  lanes.x[0] = value;
  return constant(lanes);
}

Ref Builder::constant(const Lanes& value) {
  const double* const x = value.x;
  const double* const end = x + value.width;
  const double* const first = std::find_if(x, end, [](double c) { return c != 0; });
  const bool negative = first != end && *first < 0;
  const bool uniform = std::all_of(x, end, [x](double c) { return c == *x; });
  Node node;
  node.op = Op::kConstant;
  node.index = static_cast<std::uint32_t>(region_.constants.size());
  node.count = uniform ? 1 : static_cast<std::uint32_t>(value.width);
  for (std::uint32_t k = 0; k < node.count; ++k)
    region_.constants.push_back(x[k] == 0 ? 0.0 : negative ? -x[k] : x[k]);
  const size_t nodes = region_.nodes.size();
  const Ref ref = intern(node);
  if (nodes == region_.nodes.size()) region_.constants.resize(node.index);  // known already
  return negative ? -ref : ref;
}

Lanes Builder::split_factor(Ref& x) const {
  Lanes factor;
  factor.x[0] = x.negative() ? -1.0 : 1.0;
  const Ref positive = x.positive();
  const Node& node = region_[positive];
  if (node.op != Op::kMul || !region_.is_constant(node.a)) {
    x = positive;
    return factor;
  }
  factor = region_.lanes(node.a.with_sign_of(x));
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
    if (is(a, 0)) return b;
    const auto plus = [&](Ref c) { return constant(region_.lanes(a) + region_.lanes(c)); };
    if (region_.is_constant(b)) return plus(b);
    Node inner = region_[b];
    if (inner.op == Op::kAdd) {
      if (region_.is_constant(inner.b)) std::swap(inner.a, inner.b);
      if (region_.is_constant(inner.a))
        return add(plus(inner.a.with_sign_of(b)), inner.b.with_sign_of(b));
    }
  }
  Ref x = a, y = b;
  const Lanes p = split_factor(x), r = split_factor(y);
  if (x == y) return mul(constant(p + r), x);
  bool found = false;
  if (const Ref u = fold_nested_add(a, b, found); found) return u;
  if (const Ref u = fold_nested_add(b, a, found); found) return u;
  if (const Ref u = fold_hsum(a, b, found); found) return u;
  if (const Ref u = fold_hsum(b, a, found); found) return u;

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
    if (is(a, 0)) return a;
    if (is(a, 1)) return signed_result(b);
    const auto times = [&](Ref c) { return constant(region_.lanes(a) * region_.lanes(c)); };
    if (region_.is_constant(b)) {
      const Ref product = times(b);
      return is(product, 0) ? product : signed_result(product);
    }
    const Node inner = region_[b];
    if (inner.op == Op::kMul && region_.is_constant(inner.a))
      return signed_result(mul(times(inner.a), inner.b));
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
  if (is(a, 0)) return a;
  if (a == b) return signed_result(constant(1.0));
  if (region_.is_constant(b) && !has_zero(region_.lanes(b))) {
    const Lanes divisor = region_.lanes(b);
    if (region_.is_constant(a)) return signed_result(constant(region_.lanes(a) / divisor));
    return signed_result(mul(constant(one / divisor), a));
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
  if (region_.is_constant(a) && region_[a].width == 1 && region_.value(a) >= 0)
    return constant(std::sqrt(region_.value(a)));
  return unary(Op::kSqrt, a);
}

Ref Builder::sin(Ref a) {
  if (is(a, 0)) return a.positive();
  const Ref ref = unary(Op::kSin, a.positive());
  return a.negative() ? -ref : ref;
}

Ref Builder::cos(Ref a) {
  if (is(a, 0)) return constant(1.0);
  return unary(Op::kCos, a.positive());
}

Ref Builder::stumpff(int k, Ref x) {
  if (is(x, 0)) return constant(special_value(Op::kStumpff, k, 0));
  return unary(Op::kStumpff, x, k);
}

Ref Builder::quaternion_log(Ref w) {
  const Ref ref = is(w.positive(), 1) ? constant(2.0) : unary(Op::kQuaternionLog, w.positive());
  return w.negative() ? -ref : ref;
}

Ref Builder::log_curvature(Ref w) {
  if (is(w.positive(), 1)) return constant(1.0 / 12);
  return unary(Op::kLogCurvature, w.positive());
}

Graph Builder::finish() && {
  Graph graph;
  graph.regions.push_back(std::move(region_));
  return graph;
}

}  // namespace arboc

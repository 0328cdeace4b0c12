// A graph -> passes, program, text, canonical order: the same value.
#include <cmath>
#include <string>
#include <vector>

#include "fuzz/bytes.h"
#include "fuzz/targets.h"
#include "graph/builder.h"
#include "graph/canonical.h"
#include "passes/passes.h"
#include "program/program.h"
#include "support/interpreter.h"
#include "support/rounding_bound.h"

namespace arboc::fuzz {
namespace {

/// As tests/support/random_graph: values stay below 1e6, arguments in their domains.
class Maker {
 public:
  explicit Maker(Bytes& bytes) : bytes_(bytes), builder_("fuzz") {
    for (const char* name : {"q", "v"})
      for (const Ref ref : builder_.input(name, 3)) pool_.push_back({ref, 1});
    for (int nodes = 0; !bytes_.empty() && nodes < 300; ++nodes) {
      if (bytes_.chance(8)) builder_.begin_block("block " + std::to_string(nodes));
      const Bounded next = operation();
      pool_.push_back(next.bound < 1e6 ? next : Bounded{builder_.sin(next.ref), 1});
    }
  }

  /// The last entries.
  std::vector<Ref> roots() const {
    std::vector<Ref> refs;
    for (size_t k = pool_.size() > 8 ? pool_.size() - 8 : 0; k < pool_.size(); ++k)
      refs.push_back(k % 3 == 0 ? -pool_[k].ref : pool_[k].ref);
    return refs;
  }
  Builder builder() const { return builder_; }

 private:
  struct Bounded {
    Ref ref;
    double bound = 1;
  };

  Bounded pick() {
    const unsigned choice = bytes_.next();
    Bounded x = pool_[pool_.size() - 1 - (choice >> 1) % pool_.size()];
    if (choice & 1) x.ref = -x.ref;
    return x;
  }

  Bounded operand() {
    constexpr double kValues[] = {0, 1, -1, 0.5, 2, -3, 0.1, -1e-3, 9.81, 1e-9};
    if (!bytes_.chance(40)) return pick();
    return {builder_.constant(bytes_.pick(kValues)), 10};
  }

  Bounded operation() {
    const unsigned op = bytes_.next() % 16;
    const Bounded a = operand(), b = operand();
    if (op < 6) return {builder_.add(a.ref, b.ref), a.bound + b.bound};
    if (op < 12) return {builder_.mul(a.ref, b.ref), a.bound * b.bound};
    if (op == 12) return {builder_.sin(a.ref), 1};
    if (op == 13) return {builder_.cos(a.ref), 1};
    const Ref square = builder_.add(builder_.constant(1), builder_.mul(a.ref, a.ref));
    if (op == 14) return {builder_.div(b.ref, square), b.bound};
    return {builder_.sqrt(square), a.bound + 1};
  }

  Bytes& bytes_;
  Builder builder_;
  std::vector<Bounded> pool_;
};

Graph with_output(Builder builder, const std::vector<Ref>& roots) {
  builder.output("y", roots);
  return std::move(builder).finish();
}

using Numbers = std::vector<std::vector<double>>;

void expect_within(const Numbers& a, const Numbers& b, const Numbers& bound) {
  for (size_t p = 0; p < a.size(); ++p)
    for (size_t i = 0; i < a[p].size(); ++i)
      ARBOC_FUZZ_EXPECT(a[p][i] == b[p][i] || std::fabs(a[p][i] - b[p][i]) <= bound[p][i]);
}

}  // namespace

void graph(const std::uint8_t* data, size_t size) {
  Bytes bytes(data, size);
  Numbers inputs(2);
  for (auto& port : inputs)
    for (int k = 0; k < 3; ++k) port.push_back(bytes.unit());
  const Maker maker(bytes);
  const Graph made = with_output(maker.builder(), maker.roots());
  verify(made);
  const Numbers value = evaluate(made, inputs), bound = test::rounding_bound(made, inputs);

  const Graph passed = run_passes(made);
  expect_within(value, evaluate(passed, inputs), bound);
  ARBOC_FUZZ_EXPECT(schedule(passed).ops.total() <= schedule(made).ops.total());
  for (const int chunk_ops : {1, 20, 250})
    ARBOC_FUZZ_EXPECT(test::interpret(schedule(passed, {.chunk_ops = chunk_ops}), inputs) ==
                      evaluate(passed, inputs));
  ARBOC_FUZZ_EXPECT(evaluate(parse(print(passed)), inputs) == evaluate(passed, inputs));
  for (const NodeOrder order : {NodeOrder::kByCones, NodeOrder::kByLevels}) {
    Builder builder = maker.builder();
    const std::vector<Ref> roots = canonicalise(builder, maker.roots(), order);
    const Graph canonical = with_output(builder, roots);
    verify(canonical);
    ARBOC_FUZZ_EXPECT(evaluate(canonical, inputs) == value);
    const std::vector<Ref> again = canonicalise(builder, roots, order);
    ARBOC_FUZZ_EXPECT(print(with_output(builder, again)) == print(canonical));
  }
}

}  // namespace arboc::fuzz

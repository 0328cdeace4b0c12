// canonicalise(): the same graph, in whatever order and with whatever order of operands it is made,
// comes out the same, and with the same value.
#include <gtest/gtest.h>

#include <numeric>

#include "graph/canonical.h"
#include "support/random.h"
#include "support/random_graph.h"
#include "support/rounding_bound.h"

namespace arboc::test {
namespace {

constexpr int kSeeds = 200;

/// Makes the nodes of a region again: block by block, within a block in a random order, operands
/// of sums and products in a random order.
class Shuffled {
 public:
  Shuffled(const Region& region, std::uint64_t seed)
      : in_(region),
        random_(seed),
        made_(region.nodes.size(), 0),
        out_(region.nodes.size()),
        builder_(region.name) {
    std::vector<Ref> inputs;
    for (const Port& port : in_.inputs)
      for (const Ref ref : builder_.input(port.name, port.size)) inputs.push_back(ref);
    std::vector<std::uint32_t> block;
    for (std::uint32_t n = 0; n < in_.nodes.size(); ++n) {
      const Node& node = in_.nodes[n];
      if (node.op == Op::kInput) {
        out_[n] = inputs[node.index];
        made_[n] = 1;
        continue;
      }
      if (!block.empty() && in_.nodes[block.back()].block != node.block) make(block);
      block.push_back(n);
    }
    make(block);
  }

  std::vector<Ref> roots() {
    std::vector<Ref> refs;
    for (const auto& port : in_.results)
      for (const Ref ref : port) refs.push_back(renamed(ref));
    return refs;
  }
  Builder& builder() { return builder_; }

 private:
  Ref renamed(Ref old) const { return out_[old.node()].with_sign_of(old); }

  void make(std::vector<std::uint32_t>& block) {
    if (block.empty()) return;
    builder_.begin_block(in_.blocks[in_.nodes[block.front()].block]);
    while (!block.empty()) {
      const size_t at = static_cast<size_t>(random_.integer(static_cast<int>(block.size())));
      const std::uint32_t n = block[at];
      bool ready = true;
      for_each_operand(in_, in_.nodes[n], [&](Ref r) { ready = ready && made_[r.node()]; });
      if (!ready) continue;
      make(n);
      block.erase(block.begin() + static_cast<long>(at));
    }
  }

  void make(std::uint32_t n) {
    const Node& node = in_.nodes[n];
    Ref a, b;
    if (operand_count(node.op) > 0) a = renamed(node.a);
    if (operand_count(node.op) > 1) b = renamed(node.b);
    if ((node.op == Op::kAdd || node.op == Op::kMul) && random_.chance(0.5)) std::swap(a, b);
    made_[n] = 1;
    switch (node.op) {
      case Op::kConstant: out_[n] = builder_.constant(in_.lanes(Ref(n))); break;
      case Op::kPack: {
        std::vector<Ref> scalars;
        for_each_operand(in_, node, [&](Ref r) { scalars.push_back(renamed(r)); });
        out_[n] = builder_.pack(scalars);
        break;
      }
      case Op::kLane: out_[n] = builder_.lane(a, static_cast<int>(node.index)); break;
      case Op::kHsum: out_[n] = builder_.hsum(a, static_cast<int>(node.index)); break;
      case Op::kAdd: out_[n] = builder_.add(a, b); break;
      case Op::kMul: out_[n] = builder_.mul(a, b); break;
      case Op::kDiv: out_[n] = builder_.div(a, b); break;
      case Op::kSqrt: out_[n] = builder_.sqrt(a); break;
      case Op::kSin: out_[n] = builder_.sin(a); break;
      case Op::kCos: out_[n] = builder_.cos(a); break;
      case Op::kStumpff: out_[n] = builder_.stumpff(static_cast<int>(node.index), a); break;
      case Op::kQuaternionLog: out_[n] = builder_.quaternion_log(a); break;
      case Op::kLogCurvature: out_[n] = builder_.log_curvature(a); break;
      default: FAIL();
    }
  }

  const Region& in_;
  Random random_;
  std::vector<char> made_;
  std::vector<Ref> out_;
  Builder builder_;
};

Graph canonical(const Region& region, std::uint64_t seed, NodeOrder order) {
  Shuffled shuffled(region, seed);
  const std::vector<Ref> roots = canonicalise(shuffled.builder(), shuffled.roots(), order);
  auto next = roots.begin();
  for (const Port& port : region.outputs) {
    shuffled.builder().output(port.name, {next, next + port.size});
    next += port.size;
  }
  return std::move(shuffled.builder()).finish();
}

class Canonical : public testing::TestWithParam<NodeOrder> {};

TEST_P(Canonical, DoesNotDependOnTheOrderInWhichNodesAreMade) {
  int moved = 0;
  for (const std::uint64_t seed : seeds(kSeeds)) {
    RandomGraphOptions options;
    options.nodes = seed % 2 == 0 ? 60 : 400;
    const Graph graph = random_graph(seed, options);
    const Region& region = graph.regions[0];
    const std::string text = print(canonical(region, seed, GetParam()));
    for (std::uint64_t other = 1; other <= 3; ++other)
      ASSERT_EQ(print(canonical(region, seed + 1000 * other, GetParam())), text)
          << "ARBOC_SEED=" << seed;
    Shuffled one(region, seed), two(region, seed + 1000);
    moved += one.builder().region().nodes.size() != two.builder().region().nodes.size() ||
             !(one.roots() == two.roots());
  }
  EXPECT_GT(moved, static_cast<int>(seeds(kSeeds).size()) / 2);  // the shuffling does something
}

TEST_P(Canonical, KeepsTheValue) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Graph before = random_graph(seed), after = canonical(before.regions[0], seed, GetParam());
    verify(after);
    const auto inputs = random_inputs(before, seed);
    const auto a = evaluate(before, inputs), b = evaluate(after, inputs);
    for (size_t p = 0; p < a.size(); ++p)
      for (size_t i = 0; i < a[p].size(); ++i) ASSERT_EQ(a[p][i], b[p][i]) << "ARBOC_SEED=" << seed;
    EXPECT_LE(after.regions[0].nodes.size(), before.regions[0].nodes.size() + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, Canonical,
                         testing::Values(NodeOrder::kByCones, NodeOrder::kByLevels));

}  // namespace
}  // namespace arboc::test

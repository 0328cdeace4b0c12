// Random graphs with lanes: text, passes and programs keep their values.
#include <gtest/gtest.h>

#include <cmath>

#include "graph/builder.h"
#include "passes/dead.h"
#include "passes/passes.h"
#include "program/program.h"
#include "support/interpreter.h"
#include "support/random.h"

namespace arboc::test {
namespace {

constexpr int kSeeds = 200;
constexpr int kInputs = 12;

/// Values stay below 1e3 or so: whatever gets larger is replaced by its sine.
class Generator {
 public:
  explicit Generator(std::uint64_t seed)
      : random_(seed), builder_("lanes"), width_(random_.chance(0.3) ? 2 : 4) {}

  Graph run() {
    for (const Ref ref : builder_.input("q", kInputs)) scalars_.push_back({ref, 1});
    for (int k = 0; k < 6; ++k) gather();
    const int nodes = 20 + random_.integer(300);
    for (int k = 0; k < nodes; ++k) {
      if (k % 20 == 0) builder_.begin_block("block " + std::to_string(k / 20));
      random_.chance(0.6) ? combine(wide_, any_, wide_) : narrow();
    }
    std::vector<Ref> y;
    for (int k = 0; k < 20; ++k) {
      Ref x = random_.chance(0.5) ? builder_.lane(pick(wide_).ref, random_.integer(width_))
                                  : pick(scalars_).ref;
      y.push_back(random_.chance(0.4) ? -x : x);
    }
    builder_.output("y", y);
    return std::move(builder_).finish();
  }

 private:
  struct Bounded {
    Ref ref;
    double bound;
  };
  using Pool = std::vector<Bounded>;

  Bounded pick(const Pool& pool) {
    const int size = static_cast<int>(pool.size()), recent = std::min(size, 8);
    Bounded x = pool[static_cast<size_t>(random_.chance(0.6) ? size - 1 - random_.integer(recent)
                                                             : random_.integer(size))];
    if (random_.chance(0.4)) x.ref = -x.ref;
    return x;
  }

  void keep(Pool& pool, Ref ref, double bound) {
    pool.push_back(bound < 1e3 ? Bounded{ref, bound} : Bounded{builder_.sin(ref), 1});
    any_.push_back(pool.back());
  }

  void gather() {
    std::vector<Ref> entries;
    double bound = 0;
    for (int k = 0; k < width_; ++k) {
      const Bounded x = pick(scalars_);
      entries.push_back(x.ref);
      bound = std::max(bound, x.bound);
    }
    keep(wide_, builder_.pack(entries), bound);
  }

  Bounded constant() {
    constexpr double kValues[] = {1, -1, 0, 2, 0.5, -3};
    Lanes lanes;
    lanes.width = width_;
    for (int k = 0; k < width_; ++k) lanes.x[k] = kValues[random_.integer(6)];
    return {builder_.constant(lanes), 3};
  }

  void combine(const Pool& first, const Pool& second, Pool& result) {
    const Bounded a = pick(first), b = random_.chance(0.2) ? constant() : pick(second);
    random_.chance(0.5) ? keep(result, builder_.add(a.ref, b.ref), a.bound + b.bound)
                        : keep(result, builder_.mul(a.ref, b.ref), a.bound * b.bound);
  }

  void narrow() {
    const double x = random_.uniform(0, 1);
    if (x < 0.3) {
      const Bounded a = pick(wide_);
      keep(scalars_, builder_.hsum(a.ref, 2 + random_.integer(width_ - 1)), width_ * a.bound);
    } else if (x < 0.4) {
      const Bounded a = pick(wide_);
      keep(scalars_, builder_.lane(a.ref, random_.integer(width_)), a.bound);
    } else if (x < 0.5) {
      gather();
    } else {
      const Bounded a = pick(scalars_), b = pick(scalars_);
      random_.chance(0.5) ? keep(scalars_, builder_.add(a.ref, b.ref), a.bound + b.bound)
                          : keep(scalars_, builder_.mul(a.ref, b.ref), a.bound * b.bound);
    }
  }

  Random random_;
  Builder builder_;
  int width_;
  Pool scalars_, wide_, any_;
};

std::vector<std::vector<double>> inputs_of(std::uint64_t seed) {
  Random random(seed + 77);
  const Eigen::VectorXd q = random.vector(kInputs, 1);
  return {{q.begin(), q.end()}};
}

TEST(RandomLanes, TextAndDeadNodesKeepEveryBit) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Graph graph = Generator(seed).run();
    verify(graph);
    const auto in = inputs_of(seed);
    const auto expected = evaluate(graph, in);
    const Graph alive = remove_dead(graph);
    verify(alive);
    ASSERT_EQ(evaluate(alive, in), expected) << "ARBOC_SEED=" << seed;
    const Graph again = parse(print(alive));
    verify(again);
    ASSERT_EQ(evaluate(again, in), expected) << "ARBOC_SEED=" << seed;
  }
}

// Values below 1e3, through chains of at most 300 operations that may amplify errors by their
// factors: far above rounding, far below what a wrong term would do.
TEST(RandomLanes, PassesKeepTheValue) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Graph graph = Generator(seed).run();
    const auto in = inputs_of(seed);
    const auto expected = evaluate(graph, in)[0], got = evaluate(run_passes(graph), in)[0];
    for (size_t k = 0; k < got.size(); ++k)
      ASSERT_NEAR(got[k], expected[k], 1e-7) << "ARBOC_SEED=" << seed;
  }
}

TEST(RandomLanes, ProgramIsTheGraphBitForBit) {
  for (const std::uint64_t seed : seeds(kSeeds)) {
    const Graph graph = run_passes(Generator(seed).run());
    const auto in = inputs_of(seed);
    for (const int chunk : {1, 7, 250})
      ASSERT_EQ(interpret(schedule(graph, {.chunk_ops = chunk}), in), evaluate(graph, in))
          << "ARBOC_SEED=" << seed;
  }
}

}  // namespace
}  // namespace arboc::test

#include "support/random_graph.h"

#include <algorithm>
#include <string>

#include "graph/builder.h"
#include "support/random.h"

namespace arboc::test {
namespace {

/// An expression and a bound of its absolute value.
struct Bounded {
  Ref ref;
  double bound = 1;
};

class Generator {
 public:
  Generator(std::uint64_t seed, const RandomGraphOptions& options)
      : random_(seed), options_(options), builder_("random") {}

  Graph run() {
    inputs("q", options_.inputs / 2);
    inputs("v", options_.inputs - options_.inputs / 2);
    for (int k = 0; k < options_.nodes; ++k) {
      if (k % 25 == 0) builder_.begin_block("block " + std::to_string(k / 25));
      const Bounded next = operation();
      pool_.push_back(next.bound < 1e6 ? next : Bounded{builder_.sin(next.ref), 1});
    }
    outputs("y", options_.outputs / 2);
    outputs("z", options_.outputs - options_.outputs / 2);
    return std::move(builder_).finish();
  }

 private:
  void inputs(const std::string& name, int size) {
    for (const Ref ref : builder_.input(name, size)) pool_.push_back({ref, 1});
  }
  void outputs(const std::string& name, int size) {
    std::vector<Ref> refs;
    for (int i = 0; i < size; ++i)
      refs.push_back(random_.chance(0.05) ? builder_.constant(0.75) : pick().ref);
    builder_.output(name, refs);
  }

  /// Recent ones more often, so that graphs get deep; some negated.
  Bounded pick() {
    const int size = static_cast<int>(pool_.size());
    const int recent = std::min(size, 12);
    const int at = random_.chance(0.6) ? size - 1 - random_.integer(recent) : random_.integer(size);
    Bounded x = pool_[static_cast<size_t>(at)];
    if (random_.chance(0.4)) x.ref = -x.ref;
    return x;
  }

  Bounded constant() {
    constexpr double kValues[] = {1, -1, 0.5, 2, -3, 0.1, -1e-3, 9.81};
    const double value = kValues[random_.integer(8)];
    return {builder_.constant(value), 10};
  }

  Bounded operation() {
    const Bounded a = pick(), b = random_.chance(0.15) ? constant() : pick();
    const double x = random_.uniform(0, 1);
    if (x < 0.45) return {builder_.add(a.ref, b.ref), a.bound + b.bound};
    if (x < 0.85) return {builder_.mul(a.ref, b.ref), a.bound * b.bound};
    if (x < 0.90) return {builder_.sin(a.ref), 1};
    if (x < 0.93) return {builder_.cos(a.ref), 1};
    const Ref square = builder_.add(builder_.constant(1), builder_.mul(a.ref, a.ref));
    if (x < 0.95) return {builder_.div(b.ref, square), b.bound};
    if (x < 0.97) return special(a);
    return {builder_.sqrt(square), a.bound + 1};
  }

  /// Of arguments in their domain: sin^2, and (1 + sin) / 4.
  Bounded special(const Bounded& a) {
    const Ref sine = builder_.sin(a.ref), quarter = builder_.constant(0.25);
    switch (random_.integer(3)) {
      case 0: return {builder_.stumpff(random_.integer(7), builder_.mul(sine, sine)), 1};
      case 1:
        return {builder_.quaternion_log(builder_.add(quarter, builder_.mul(quarter, sine))), 4};
      default: return {builder_.log_curvature(builder_.mul(quarter, sine)), 1};
    }
  }

  Random random_;
  RandomGraphOptions options_;
  Builder builder_;
  std::vector<Bounded> pool_;
};

}  // namespace

Graph random_graph(std::uint64_t seed, const RandomGraphOptions& options) {
  return Generator(seed, options).run();
}

std::vector<std::vector<double>> random_inputs(const Graph& graph, std::uint64_t seed) {
  Random random(seed + 1000003);
  std::vector<std::vector<double>> inputs;
  for (const Port& port : graph.regions.back().inputs) {
    inputs.emplace_back();
    for (int i = 0; i < port.size; ++i) inputs.back().push_back(random.uniform(-1, 1));
  }
  return inputs;
}

}  // namespace arboc::test

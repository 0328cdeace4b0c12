// Inverse dynamics and mass matrix of models/ur5 by generated code, by the generic engine, and by
// the peers that are installed: one process, the same states, results compared first.
//
// Debian builds KDL, DART and MuJoCo without AVX and fused multiply-adds, while generated code and
// the generic engine are built with -march=native: their rows say how good the generic engine is,
// not how good they could be. Peers allocate their result; DART's rows include setting the state,
// which its interface demands.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "differential/peer.h"
#include "frontend/read_model.h"
#include "generic.h"
#include "state_source.h"
#include "tree/lower.h"
#include "ur5/ur5_raw.hpp"

namespace {

using namespace arboc;

constexpr int kStates = 32;

struct Setup {
  Model model;
  std::vector<State> states;
  DynamicTree tree;

  Setup() {
    Diagnostics diagnostics;
    model = configure(read_model(ARBOC_SOURCE_DIR "/models/ur5/ur5.urdf", diagnostics), {},
                      diagnostics);
    tree = lower(model, {FrameChoice::kAxis, true});
    StateSource source(7);
    for (int s = 0; s < kStates; ++s) states.push_back(source.next(model));
  }
};

const Setup& setup() {
  static const Setup instance;
  return instance;
}

/// Runs call(state) over the states in turn.
template <class Call>
void cycle(benchmark::State& bench, Call&& call) {
  size_t s = 0;
  for (auto _ : bench) {
    call(setup().states[s]);
    s = (s + 1) % kStates;
  }
}

void generated_rnea(benchmark::State& bench) {
  double tau[ur5::nv];
  cycle(bench, [&](const State& s) {
    ur5::raw::rnea<double>(s.q.data(), s.v.data(), s.a.data(), tau);
    benchmark::DoNotOptimize(tau);
  });
}

void generated_crba(benchmark::State& bench) {
  double M[ur5::sparsity::crba_M_nnz];
  cycle(bench, [&](const State& s) {
    ur5::raw::crba<double>(s.q.data(), M);
    benchmark::DoNotOptimize(M);
  });
}

void generic_rnea(benchmark::State& bench) {
  bench::Generic generic(setup().tree);
  double tau[ur5::nv];
  cycle(bench, [&](const State& s) {
    generic.rnea(s.q.data(), s.v.data(), s.a.data(), tau);
    benchmark::DoNotOptimize(tau);
  });
}

void generic_crba(benchmark::State& bench) {
  bench::Generic generic(setup().tree);
  double M[ur5::nv * ur5::nv];
  cycle(bench, [&](const State& s) {
    generic.crba(s.q.data(), M);
    benchmark::DoNotOptimize(M);
  });
}

/// Stops the program if generated code and a peer disagree.
void compare(test::Peer& peer, const test::PeerKind& kind) {
  for (const State& s : setup().states) {
    Eigen::VectorXd tau(ur5::nv);
    ur5::raw::rnea<double>(s.q.data(), s.v.data(), s.a.data(), tau.data());
    const Eigen::VectorXd expected = peer.rnea(s.q, s.v, s.a);
    const double error = (tau - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
    if (error <= kind.tolerance) continue;
    std::fprintf(stderr, "%s disagrees by %.1e\n", kind.name, error);
    std::exit(5);
  }
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  benchmark::RegisterBenchmark("rnea/generated", generated_rnea);
  benchmark::RegisterBenchmark("rnea/generic", generic_rnea);
  benchmark::RegisterBenchmark("crba/generated", generated_crba);
  benchmark::RegisterBenchmark("crba/generic", generic_crba);
  std::vector<std::shared_ptr<test::Peer>> built;
  for (const test::PeerKind& kind : test::peers()) {
    std::shared_ptr<test::Peer> peer = kind.make(setup().model);
    if (!peer) continue;
    compare(*peer, kind);
    built.push_back(peer);
    benchmark::RegisterBenchmark((std::string("rnea/") + kind.name).c_str(),
                                 [peer](benchmark::State& bench) {
                                   cycle(bench, [&](const State& s) {
                                     benchmark::DoNotOptimize(peer->native_rnea(s.q, s.v, s.a));
                                   });
                                 });
    benchmark::RegisterBenchmark(
        (std::string("crba/") + kind.name).c_str(), [peer](benchmark::State& bench) {
          cycle(bench, [&](const State& s) { benchmark::DoNotOptimize(peer->native_crba(s.q)); });
        });
  }
  benchmark::RunSpecifiedBenchmarks();
}

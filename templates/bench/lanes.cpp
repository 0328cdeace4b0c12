// Times functions of @name@ at one state and at many in lanes: one translation unit, the same flags,
// the same states, results compared first.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "@name@/@name@_batch.hpp"
@includes@
namespace {

double now() {
  return std::chrono::duration<double, std::nano>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

template <class F, class S>
std::vector<std::vector<S>> outputs(int states) {
  std::vector<std::vector<S>> out;
  for (int k = 0; k < F::outputs; ++k)
    out.emplace_back(static_cast<size_t>(F::output_size[k]) * static_cast<size_t>(states));
  return out;
}

template <class Out, class Pointer>
void point(Out& out, Pointer* to) {
  for (auto& x : out) *to++ = x.data();
}

/// Ways to pass through all states once.
template <class F>
class Passes {
 public:
  Passes(int states, const double* const* in)
      : states_(states), in_(in), expected_(outputs<F, double>(states)) {
    auto out = outputs<F, double>(1);
    passes_.push_back([this, out]() mutable {
      double* to[F::outputs + 1];
      point(out, to);
      for (int s = 0; s < states_; ++s) {
        scalar(s, to);
        asm volatile("" : : "r"(to[0]) : "memory");
      }
    });
    for (int s = 0; s < states; ++s) {
      double* to[F::outputs + 1];
      for (size_t k = 0; k < F::outputs; ++k) to[k] = expected_[k].data() + s * F::output_size[k];
      scalar(s, to);
    }
    differences_.push_back(0);
  }

  /// Calls on packs that are there already, results left in packs.
  template <class S, int N>
  void add() {
    using P = arboc::Pack<S, N>;
    const auto given = inputs<S>();
    std::vector<std::vector<P>> in;
    const int blocks = states_ / N;
    for (size_t k = 0; k < F::inputs; ++k) {
      const int size = F::input_size[k];
      in.emplace_back(static_cast<size_t>(size) * static_cast<size_t>(blocks));
      for (int b = 0; b < blocks; ++b)
        arboc::load<S, N>(given[k].data(), size, static_cast<size_t>(b * N),
                          static_cast<size_t>(states_), in[k].data() + b * size);
    }
    auto out = outputs<F, P>(1);
    passes_.push_back([in, out, blocks]() mutable {
      P* to[F::outputs + 1];
      point(out, to);
      for (int b = 0; b < blocks; ++b) {
        const P* from[F::inputs + 1];
        for (size_t k = 0; k < F::inputs; ++k) from[k] = in[k].data() + b * F::input_size[k];
        F::template call<P>(from, to);
        asm volatile("" : : "r"(to[0]) : "memory");
      }
    });
    add_arrays<S, N>();
  }

  void results(double* ns, double* difference) {
    std::vector<double> best(passes_.size(), std::numeric_limits<double>::infinity());
    for (auto& pass : passes_) pass();
    const double once = now();
    passes_[0]();
    const int repeat = static_cast<int>(30e3 / (now() - once)) + 1;  // windows of some 30 us
    const double end = now() + 0.1e9 * static_cast<double>(passes_.size());
    while (now() < end)
      for (size_t k = 0; k < passes_.size(); ++k) {
        const double start = now();
        for (int r = 0; r < repeat; ++r) passes_[k]();
        best[k] = std::min(best[k], (now() - start) / (repeat * static_cast<double>(states_)));
      }
    for (size_t k = 0; k < passes_.size(); ++k) {
      ns[k] = best[k];
      difference[k] = differences_[k];
    }
  }

 private:
  void scalar(int s, double* const* out) const {
    const double* from[F::inputs + 1];
    for (size_t k = 0; k < F::inputs; ++k) from[k] = in_[k] + s * F::input_size[k];
    F::template call<double>(from, out);
  }

  template <class S>
  std::vector<std::vector<S>> inputs() const {
    std::vector<std::vector<S>> in;
    for (size_t k = 0; k < F::inputs; ++k)
      in.emplace_back(in_[k], in_[k] + states_ * F::input_size[k]);
    return in;
  }

  /// arboc::Batch from arrays of states to arrays of results, which are compared.
  template <class S, int N>
  void add_arrays() {
    using Batch = arboc::Batch<F, S, N>;
    const auto batch = std::make_shared<Batch>();
    const auto in = std::make_shared<std::vector<std::vector<S>>>(inputs<S>());
    const auto out = std::make_shared<std::vector<std::vector<S>>>(outputs<F, S>(states_));
    passes_.push_back([this, batch, in, out] {
      evaluate(*batch, *in, *out, std::make_index_sequence<F::inputs>(),
               std::make_index_sequence<F::outputs>());
    });
    passes_.back()();
    double worst = 0;
    for (size_t k = 0; k < F::outputs; ++k) {
      double scale = 1e-9, error = 0;
      for (size_t i = 0; i < expected_[k].size(); ++i) {
        const double x = expected_[k][i], d = std::fabs(static_cast<double>((*out)[k][i]) - x);
        if (!(d <= error)) error = d;
        if (std::fabs(x) > scale) scale = std::fabs(x);
      }
      if (!(error / scale <= worst)) worst = error / scale;
    }
    differences_.insert(differences_.end(), 2, worst);
  }

  template <class Batch, class S, size_t... I, size_t... O>
  void evaluate(Batch& batch, const std::vector<std::vector<S>>& in,
                std::vector<std::vector<S>>& out, std::index_sequence<I...>,
                std::index_sequence<O...>) const {
    batch.evaluate(static_cast<size_t>(states_), {in[I].data()...}, {out[O].data()...});
    asm volatile("" : : "r"(out.data()) : "memory");
  }

  int states_;
  const double* const* in_;
  std::vector<std::vector<double>> expected_;
  std::vector<std::function<void()>> passes_;
  std::vector<double> differences_;
};

template <class F>
void bench(int states, const double* const* in, double* ns, double* difference) {
  Passes<F> passes(states, in);
@variants@  passes.results(ns, difference);
}

}  // namespace

/// in: the function's inputs at all states, a multiple of the lanes.  ns per state and relative
/// difference: of one state a call, then of each kind of lanes within packs and from and to arrays.
extern "C" void arboc_bench_lanes(int function, int states, const double* const* in, double* ns,
                                  double* difference) {
  switch (function) {
@cases@  }
}

// Functions of @name@ at one state and at many in lanes, to be timed and compared: one translation
// unit, the same flags, the same states.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "@name@/@name@_batch.hpp"
@includes@
namespace {

/// Ways to pass through all states once, and how far the results of each are from the first one's.
struct Ways {
  std::vector<std::function<void()>> passes;
  std::vector<double> differences;
};

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
    ways_.passes.push_back([this, out]() mutable {
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
    ways_.differences.push_back(0);
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
    ways_.passes.push_back([in, out, blocks]() mutable {
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

  const Ways& ways() const { return ways_; }

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
    ways_.passes.push_back([this, batch, in, out] {
      evaluate(*batch, *in, *out, std::make_index_sequence<F::inputs>(),
               std::make_index_sequence<F::outputs>());
    });
    ways_.passes.back()();
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
    ways_.differences.insert(ways_.differences.end(), 2, worst);
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
  Ways ways_;
};

template <class F>
Ways ways_of(int states, const double* const* in) {
  static std::unique_ptr<Passes<F>> passes;  // the ways refer to it
  passes = std::make_unique<Passes<F>>(states, in);
@variants@  return passes->ways();
}

std::vector<Ways>& all_ways() {
  static std::vector<Ways> ways(@count@);
  return ways;
}

}  // namespace

/// in: the function's inputs at all states, a multiple of the lanes; both outlive the passes.
/// Returns the relative differences: of one state a call, then of each kind of lanes within packs
/// and from and to arrays.
extern "C" const double* arboc_lanes_open(int function, int states, const double* const* in) {
  Ways& ways = all_ways()[static_cast<size_t>(function)];
  switch (function) {
@cases@  }
  return ways.differences.data();
}

/// Goes through all states in that way.
extern "C" void arboc_lanes_pass(int function, int way) {
  all_ways()[static_cast<size_t>(function)].passes[static_cast<size_t>(way)]();
}

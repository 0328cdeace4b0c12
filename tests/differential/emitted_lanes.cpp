// Emitted functions on packs and in batches against the same functions of one state: rnea and
// aba of ur5 and, with -DARBOC_ALL, more of it and of a quadruped with a floating base.  Prints
// what disagrees; exit status 1 if anything does.
#include <ur5/ur5_aba.hpp>
#include <ur5/ur5_batch.hpp>
#include <ur5/ur5_crba.hpp>
#include <ur5/ur5_rnea.hpp>
#include <ur5/ur5_rnea_derivatives.hpp>
#ifdef ARBOC_ALL
#include <quadruped/quadruped_aba.hpp>
#include <quadruped/quadruped_batch.hpp>
#include <quadruped/quadruped_crba.hpp>
#include <quadruped/quadruped_difference.hpp>
#include <quadruped/quadruped_integrate.hpp>
#include <quadruped/quadruped_rnea.hpp>
#include <quadruped/quadruped_rnea_derivatives.hpp>
#endif

#include <cmath>
#include <cstdio>
#include <random>
#include <utility>
#include <vector>

namespace {

int failures = 0;

void check(bool good, const char* function, int lanes, int threads, const char* what) {
  if (good) return;
  std::printf("%s, %d lanes, %d threads: %s\n", function, lanes, threads, what);
  ++failures;
}

template <class S>
using Arguments = std::vector<std::vector<S>>;

/// Random inputs of n states; of a floating base with unit quaternions.
template <class F, class S>
Arguments<S> random_inputs(std::size_t n, bool floating) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-2, 2);
  Arguments<S> in;
  for (std::size_t k = 0; k < F::inputs; ++k) {
    in.emplace_back(n * F::input_size[k]);
    for (S& x : in[k]) x = static_cast<S>(uniform(engine));
    // q comes first; the second configuration of difference is as long.
    if (!floating || F::input_size[k] != F::input_size[0]) continue;
    for (std::size_t s = 0; s < n; ++s) {
      S* const u = &in[k][s * F::input_size[k] + 3];
      const S length = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2] + u[3] * u[3]);
      for (int i = 0; i < 4; ++i) u[i] /= length;
    }
  }
  return in;
}

template <class F, class S>
Arguments<S> zero_outputs(std::size_t n) {
  Arguments<S> out;
  for (std::size_t k = 0; k < F::outputs; ++k) out.emplace_back(n * F::output_size[k], S(-1));
  return out;
}

template <class F>
void one_by_one(const Arguments<double>& in, std::size_t n, Arguments<double>& out) {
  for (std::size_t s = 0; s < n; ++s) {
    const double* x[F::inputs];
    double* y[F::outputs];
    for (std::size_t k = 0; k < F::inputs; ++k) x[k] = &in[k][s * F::input_size[k]];
    for (std::size_t k = 0; k < F::outputs; ++k) y[k] = &out[k][s * F::output_size[k]];
    const int status = F::template call<double>(x, y);
    if (status != 0) check(false, F::name, 1, 1, "status");
  }
}

template <class F, class S, int N, std::size_t... I, std::size_t... O>
void in_batch(arboc::Batch<F, S, N>& batch, const Arguments<S>& in, std::size_t n,
              Arguments<S>& out, int* status, std::index_sequence<I...>,
              std::index_sequence<O...>) {
  batch.evaluate(n, {in[I].data()...}, {out[O].data()...}, status);
}
template <class F, class S, int N>
Arguments<S> in_batch(arboc::Batch<F, S, N>& batch, const Arguments<S>& in, std::size_t n,
                      std::vector<int>& status) {
  Arguments<S> out = zero_outputs<F, S>(n);
  status.assign(n, -1);
  in_batch(batch, in, n, out, status.data(), std::make_index_sequence<F::inputs>(),
           std::make_index_sequence<F::outputs>());
  return out;
}

/// Rounding of differently fused sums, relative to an output's largest entry; forward dynamics
/// multiplies it with the condition of M.
template <class S>
bool close(const std::vector<S>& got, const std::vector<double>& expected, double tolerance) {
  double scale = 1, error = 0;
  for (const double x : expected) scale = std::fmax(scale, std::fabs(x));
  for (std::size_t i = 0; i < got.size(); ++i) {
    const double d = std::fabs(static_cast<double>(got[i]) - expected[i]);
    if (!(d <= error)) error = d;
  }
  return error <= tolerance * scale;
}

template <class F, class S, int N>
void compare(std::size_t n, bool floating, double tolerance) {
  const Arguments<double> in = random_inputs<F, double>(n, floating);
  Arguments<double> expected = zero_outputs<F, double>(n);
  one_by_one<F>(in, n, expected);
  Arguments<S> given;
  for (const auto& x : in) given.emplace_back(x.begin(), x.end());
  std::vector<int> status;
  arboc::Batch<F, S, N> alone, shared(2);
  const Arguments<S> first = in_batch(alone, given, n, status);
  for (const int s : status) check(s == 0, F::name, N, 1, "status");
  for (std::size_t k = 0; k < F::outputs; ++k)
    check(close(first[k], expected[k], tolerance), F::name, N, 1, "values");
  check(in_batch(shared, given, n, status) == first, F::name, N, 2, "differs from one thread");
  check(in_batch(shared, given, n, status) == first, F::name, N, 2, "differs the second time");
}

/// 29 states are no multiple of any width, 3 fewer than most.
template <class F>
void compare_all(bool floating, double tolerance = 1e-13) {
  for (const std::size_t n : {29, 3, 1, 16, 0}) {
    compare<F, double, 2>(n, floating, tolerance);
    compare<F, double, 4>(n, floating, tolerance);
    compare<F, double, 8>(n, floating, tolerance);
    compare<F, float, 8>(n, floating, tolerance * 0x1p29);
  }
}

/// A state that is not a number in one lane: its forward dynamics fail, the others' do not.
template <class F, int N>
void singular_lane() {
  constexpr std::size_t n = 2 * N + 1, bad = N + 1;
  Arguments<double> in = random_inputs<F, double>(n, false);
  std::vector<int> status;
  arboc::Batch<F, double, N> batch;
  const Arguments<double> good = in_batch(batch, in, n, status);
  in[0][bad * F::input_size[0] + 1] = std::nan("");
  const Arguments<double> out = in_batch(batch, in, n, status);
  for (std::size_t s = 0; s < n; ++s) {
    check((status[s] != 0) == (s == bad), F::name, N, 1, "status of the singular lane");
    for (int i = 0; i < F::output_size[0]; ++i) {
      const std::size_t at = s * F::output_size[0] + i;
      check(s == bad ? std::isnan(out[0][at]) : out[0][at] == good[0][at], F::name, N, 1,
            "values beside or in the singular lane");
    }
  }
}

/// Blocks come once each with their results; inputs of stride 0 serve all states.
void blocks() {
  constexpr std::size_t n = 21;
  using F = ur5::rnea_fn;
  const Arguments<double> in = random_inputs<F, double>(n, false);
  arboc::Batch<F, double, 4> batch(2);
  double tau[n][6];
  batch.for_each_block(n, {in[0].data(), {in[1].data(), 0}, in[2].data()}, [&](const auto& block) {
    for (int lane = 0; lane < block.count; ++lane)
      for (int i = 0; i < 6; ++i) tau[block.first + lane][i] = block.out[0][i][lane];
  });
  for (std::size_t s = 0; s < n; ++s) {
    double expected[6];
    ur5::raw::rnea<double>(&in[0][6 * s], &in[1][0], &in[2][6 * s], expected);
    for (int i = 0; i < 6; ++i)
      check(std::fabs(tau[s][i] - expected[i]) < 1e-11, F::name, 4, 2, "blocks");
  }
}

}  // namespace

int main() {
  compare_all<ur5::rnea_fn>(false);
  compare_all<ur5::aba_fn>(false, 1e-11);
#ifdef ARBOC_ALL
  compare_all<ur5::crba_fn>(false);
  compare_all<ur5::rnea_derivatives_fn>(false);
  compare_all<quadruped::rnea_fn>(true);
  compare_all<quadruped::crba_fn>(true);
  compare_all<quadruped::rnea_derivatives_fn>(true);
  compare_all<quadruped::aba_fn>(true, 1e-11);
  compare_all<quadruped::integrate_fn>(true);
  compare_all<quadruped::difference_fn>(true);
#endif
  singular_lane<ur5::aba_fn, 4>();
  singular_lane<ur5::aba_fn, 8>();
  blocks();
  return failures == 0 ? 0 : 1;
}

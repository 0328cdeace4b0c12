// A generated function as C functions on arrays: one state, or many in lanes and over threads.
//
// Matrices are handed over dense and by rows.  A translation unit a function says, beside its
// headers, which outputs are sparse and how they become dense:
//
//   struct Outputs {
//     static constexpr int size[] = {36};   // entries of each dense output
//     static constexpr bool sparse[] = {true};
//     static void scatter(int k, const double* entries, double* dense);
//   };
//   ARBOC_PYTHON(crba, ur5::crba_fn, Outputs)
#pragma once

#include <algorithm>
#include <cstddef>

#include "arboc/batch.hpp"

namespace arboc_python {

template <class F, class Outputs>
class Caller {
 public:
  /// Below this many states a thread more costs what it brings.
  static constexpr std::size_t kFew = 2048;

  explicit Caller(int threads) : team_(threads) {}

  static int one(const double* const* in, double* const* out) {
    double entries[kLargest];
    double* to[F::outputs];
    for (int k = 0, used = 0; k < F::outputs; ++k) {
      to[k] = Outputs::sparse[k] ? entries + used : out[k];
      if (Outputs::sparse[k]) used += F::output_size[k];
    }
    const int status = F::template call<double>(in, to);
    for (int k = 0; k < F::outputs; ++k)
      if (Outputs::sparse[k]) Outputs::scatter(k, to[k], out[k]);
    return status;
  }

  /// Entry i of state s of input k is in[k][s * strides[k] + i].
  void many(std::size_t n, const double* const* in, const std::ptrdiff_t* strides,
            double* const* out, int* status) {
    typename Batch::Inputs rows = inputs(in, strides, std::make_index_sequence<F::inputs>());
    const auto consume = [&](const auto& block) { write(block, n, out, status); };
    (n < kFew ? alone_ : team_).for_each_block(n, rows, consume);
  }

 private:
  using Batch = arboc::Batch<F>;

  static constexpr int sum() {
    int all = 1;
    for (int k = 0; k < F::outputs; ++k) all += F::output_size[k];
    return all;
  }
  static constexpr int kLargest = sum();

  template <std::size_t... k>
  static typename Batch::Inputs inputs(const double* const* in, const std::ptrdiff_t* strides,
                                       std::index_sequence<k...>) {
    return {arboc::Rows<const double>(in[k], strides[k])...};
  }

  template <class Block>
  static void write(const Block& block, std::size_t n, double* const* out, int* status) {
    for (int k = 0; k < F::outputs; ++k) {
      if (Outputs::sparse[k])
        scatter(block, k, out[k]);
      else
        arboc::store(block.out[k], F::output_size[k], block.first, n, arboc::Rows<double>(out[k]));
    }
    if (status)
      for (int lane = 0; lane < block.count; ++lane)
        status[block.first + static_cast<std::size_t>(lane)] = block.status[lane];
  }

  template <class Block>
  static void scatter(const Block& block, int k, double* out) {
    double entries[kLargest];
    for (int lane = 0; lane < block.count; ++lane) {
      for (int e = 0; e < F::output_size[k]; ++e) entries[e] = block.out[k][e][lane];
      const std::size_t state = block.first + static_cast<std::size_t>(lane);
      Outputs::scatter(k, entries, out + state * static_cast<std::size_t>(Outputs::size[k]));
    }
  }

  Batch alone_;
  Batch team_;
};

}  // namespace arboc_python

#define ARBOC_PYTHON(name, F, Outputs)                                                           \
  extern "C" {                                                                                   \
  int name##_one(const double* const* in, double* const* out) {                                  \
    return arboc_python::Caller<F, Outputs>::one(in, out);                                       \
  }                                                                                              \
  void* name##_create(int threads) { return new arboc_python::Caller<F, Outputs>(threads); }     \
  void name##_destroy(void* caller) {                                                            \
    delete static_cast<arboc_python::Caller<F, Outputs>*>(caller);                               \
  }                                                                                              \
  void name##_many(void* caller, std::size_t n, const double* const* in,                         \
                   const std::ptrdiff_t* strides, double* const* out, int* status) {             \
    static_cast<arboc_python::Caller<F, Outputs>*>(caller)->many(n, in, strides, out, status);   \
  }                                                                                              \
  }

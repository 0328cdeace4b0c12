// A generated function at many states: N states a call, in lanes, and blocks of N over threads.
//
//   #include <ur5/ur5_batch.hpp>   // what batches know of the functions
//   #include <ur5/ur5_rnea.hpp>    // the function itself
//   arboc::Batch<ur5::rnea_fn> batch;
//   batch.evaluate(n, {q, v, a}, {tau});  // q: n x 6, one state a row
//
// The wider the vectors that the compiler may use, the faster; vectorisation across statements only
// costs time (-fno-tree-vectorize).  Link with -pthread where the C library asks for it.
#ifndef ARBOC_BATCH_HPP
#define ARBOC_BATCH_HPP

#include <array>
#include <cstddef>
#include <vector>

#include "pack.hpp"
#include "rows.hpp"
#include "team.hpp"

namespace arboc {
inline namespace v1 {

/// N states and what the function gave for them.
template <class S, int N>
struct Block {
  std::size_t first;             ///< the state in lane 0
  int count;                     ///< lanes that hold states; the others repeat the last one
  int member;                    ///< of the team, from 0: who computes this block
  const Pack<S, N>* const* in;   ///< arguments of the function
  const Pack<S, N>* const* out;  ///< until the consumer returns
  LaneStatus<N> status;          ///< of checked functions, otherwise 0
};

/// F at many states.  F says what it is: `inputs`, `outputs`, `input_size`, `output_size` (of
/// matrices structural non-zeros, in the order of NAME::sparsity), `call`.  A state's result does
/// not depend on the states beside it nor on the number of threads.
template <class F, class S = double, int N = kLanes<S>>
class Batch {
 public:
  using P = Pack<S, N>;
  using Inputs = std::array<Rows<const S>, F::inputs>;
  using Outputs = std::array<Rows<S>, F::outputs>;

  explicit Batch(int threads = 1) : team_(threads) {
    for (int k = 0; k < F::inputs; ++k) entries_ += static_cast<std::size_t>(F::input_size[k]);
    for (int k = 0; k < F::outputs; ++k) entries_ += static_cast<std::size_t>(F::output_size[k]);
    packs_.resize(entries_ * static_cast<std::size_t>(team_.size()));
  }

  /// Writes the outputs of n states, and what the function returned for each if `status` is given.
  void evaluate(std::size_t n, const Inputs& in, const Outputs& out, int* status = nullptr) {
    for_each_block(n, in, [&](const Block<S, N>& block) {
      for (std::size_t k = 0; k < F::outputs; ++k)
        store(block.out[k], F::output_size[k], block.first, n, out[k]);
      if (status)
        for (int lane = 0; lane < block.count; ++lane)
          status[block.first + static_cast<std::size_t>(lane)] = block.status[lane];
    });
  }

  /// Calls consume(const Block<S, N>&) for each block of n states while its results are in the
  /// cache, at the same time from all members of the team, which hold consecutive blocks each.  It
  /// must not throw.
  template <class Consumer>
  void for_each_block(std::size_t n, const Inputs& in, Consumer&& consume) {
    const std::size_t blocks = (n + N - 1) / N, members = static_cast<std::size_t>(team_.size());
    team_.run([&](int member) {
      const std::size_t m = static_cast<std::size_t>(member);
      run(blocks * m / members, blocks * (m + 1) / members, n, in, member, consume);
    });
  }

 private:
  template <class Consumer>
  void run(std::size_t begin, std::size_t end, std::size_t n, const Inputs& from, int member,
           Consumer& consume) {
    P* in[F::inputs + 1];
    P* out[F::outputs + 1];
    P* next = packs_.data() + static_cast<std::size_t>(member) * entries_;
    for (int k = 0; k < F::inputs; next += F::input_size[k++]) in[k] = next;
    for (int k = 0; k < F::outputs; next += F::output_size[k++]) out[k] = next;
    Block<S, N> block{0, 0, member, in, out, {}};
    for (std::size_t b = begin; b < end; ++b) {
      block.first = b * N;
      block.count = static_cast<int>(n - block.first < N ? n - block.first : N);
      for (std::size_t k = 0; k < F::inputs; ++k)
        if (from[k].stride != 0 || b == begin)
          load(from[k], F::input_size[k], block.first, n, in[k]);
      block.status = F::template call<P>(in, out);
      consume(static_cast<const Block<S, N>&>(block));
    }
  }

  Team team_;
  std::size_t entries_ = 0;  ///< packs a member needs
  std::vector<P> packs_;     ///< arguments and results of the members, one after the other
};

}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_BATCH_HPP

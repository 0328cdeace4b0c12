// The chain rule between inputs of functions, which are sums of variables, and the variables.
//
// Inputs come in bundles that depend on the same variables: of a motion q, v and a of a coordinate
// at an instant, all by the same few control points.  Second derivatives by two bundles are a small
// dense matrix W; what variables get of it is C_left^T W C_right, whose rows stand side by side in
// the result.  So there is a list entry a run of numbers, not one a number: in a motion of a human
// 6 times fewer, and the lists, not the sums, are what takes time.
#ifndef ARBOC_NLP_CHAIN_HPP
#define ARBOC_NLP_CHAIN_HPP

#include <arboc/pack.hpp>
#include <utility>
#include <vector>

#include "affine.hpp"

namespace arboc {
inline namespace v1 {
namespace nlp {

/// Inputs of functions, one behind the other, as sums of variables: those of input k are entries
/// begin[k], ..., begin[k + 1] - 1 of `variable` (ascending, none twice) and `coefficient`.
struct Inputs {
  std::vector<int> begin{0}, variable{};
  std::vector<double> coefficient{}, constant{};

  int size() const { return static_cast<int>(constant.size()); }
  void push(const Affine& a);  ///< of variables only
  void evaluate(const double* x, double* values) const;
};

/// A part of a list for each member of a team, so that no two write to the same numbers: between
/// begin[m] and begin[m + 1].  `low` and `high` are the first and last number that each item writes
/// to; parts are as even as that allows.
std::vector<int> parts_of(const std::vector<int>& low, const std::vector<int>& high, int members);

/// first[target] += factor * (d output / d input) * coefficient, for all variables of inputs.
class GradientChain {
 public:
  /// `source`: the derivative by `input`; `target` has where each variable of the input stands.
  void add(const Inputs& inputs, int input, int source, double factor,
           const std::vector<int>& target);
  void share_out(int members);
  void run(const Inputs& inputs, int member, const double* source, double* target) const;

 private:
  struct Run {
    int target, source, coefficient, count;
    double factor;
  };
  std::vector<Run> runs_;
  std::vector<int> parts_{0, 0};
};

/// The lower triangle of a sparse symmetric matrix while it is found, then where entries stand.
class LowerTriangle {
 public:
  explicit LowerTriangle(int n) : columns_(static_cast<std::size_t>(n)) {}

  void add(int i, int j);
  void finish();  ///< by rows, columns ascending; nothing can be added any more
  int entry(int i, int j) const;
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (int row = 0; row < static_cast<int>(columns_.size()); ++row)
      for (const int col : columns_[static_cast<std::size_t>(row)]) visit(row, col);
  }

 private:
  std::vector<std::vector<int>> columns_;
  std::vector<int> first_;
};

class HessianChain {
 public:
  /// Inputs `first`, ... `last` - 1 are those of one evaluation.
  void begin_evaluation(const Inputs& inputs, int first, int last);
  /// Of that evaluation: `source` is the derivative by two inputs, in both orders.
  void add(int left, int right, int source);

  /// What the entries that were added reach.
  void list(LowerTriangle& triangle);
  void lay_out(const LowerTriangle& triangle);
  void share_out(int members);
  /// Adds to the entries of the triangle.
  void run(int member, const double* source, double* target);

 private:
  using P = Pack<double, 4>;

  /// Inputs that share variables; C is inputs x variables, by rows of packs, 0 behind the end.
  struct Bundle {
    std::vector<int> variables;
    int inputs, width;  ///< width: packs a row
    std::vector<P> C;

    double& c(int input, int variable) {
      return reinterpret_cast<double*>(C.data())[4 * input * width + variable];
    }
  };
  struct Entry {
    int at, mirror, source;  ///< in W, by rows; mirror < 0: none
  };
  struct Run {
    int target, from, count;  ///< from an entry of the product
  };
  /// Of two bundles; `entry` and `run` are behind the last of each.
  struct Block {
    int left, right, entry, run;
  };
  struct Draft {
    int left, right;
    std::vector<Entry> entries;
    std::vector<std::pair<int, int>> pairs;  ///< of variables that the entries reach
  };
  struct Scratch {
    std::vector<double> W;
    std::vector<P> row, product;
  };
  void add_bundle(const Inputs& inputs, const std::vector<int>& members);
  std::vector<std::pair<int, int>> pairs_of(const Draft& draft);
  void contract(const Block& block, int first_entry, const double* source, Scratch& scratch) const;

  std::vector<Bundle> bundles_;
  std::vector<int> bundle_of_, place_of_;  ///< of the inputs of an evaluation, from first_input_
  int first_input_ = 0;
  std::vector<int> draft_of_;  ///< of the evaluation: by pairs of its bundles; -1: none yet
  int first_bundle_ = 0;
  std::vector<Draft> drafts_;  ///< until they are laid out
  std::vector<Block> blocks_;
  std::vector<Entry> entries_;
  std::vector<Run> runs_;
  std::vector<int> parts_{0, 0};
  std::vector<Scratch> scratch_{1};
};

}  // namespace nlp
}  // namespace v1
}  // namespace arboc

#endif  // ARBOC_NLP_CHAIN_HPP

// The order of two commuting derivatives is one decision for each pair of blocks and each relation
// of the positions in them (before, same, behind): that of the joints in the tree decides what a
// sweep has to pass through.  Decisions are reversed one by one as long as operations get fewer.
#include "derive/hessian.h"

#include "derive/cost.h"
#include "derive/forward.h"
#include "derive/reverse.h"
#include "derive/rules.h"

namespace arboc {
namespace {

/// All E_j(E_i f), i the row.
struct Table {
  size_t n = 0;
  std::vector<Ref> entry;

  Ref operator()(size_t i, size_t j) const { return entry[i * n + j]; }
};

Table iterate(Builder& builder, const WeightedSum& sum,
              const std::vector<Coordinate>& coordinates) {
  const size_t n = coordinates.size();
  const std::vector<Ref> rows = gradient(builder, sum, coordinates);
  Table table{n, std::vector<Ref>(n * n)};
  ForwardSweep sweep(builder, rows, coordinates);
  for (size_t j = 0; j < n; ++j) {
    sweep.run(coordinates[j]);
    for (size_t i = 0; i < n; ++i) table.entry[i * n + j] = sweep[rows[i]];
  }
  return table;
}

class Chooser {
 public:
  Chooser(Builder& builder, const Table& table, const std::vector<CoordinateBlock>& blocks,
          const std::vector<BlockPair>& pairs)
      : builder_(builder),
        table_(table),
        blocks_(blocks),
        pairs_(pairs),
        swapped_(3 * pairs.size(), 0) {
    size_t at = 0;
    for (const CoordinateBlock& block : blocks) {
      first_.push_back(at);
      at += block.size();
    }
    mean_ = builder.constant(0.5);
  }

  std::vector<SparseMatrix> run() {
    std::vector<SparseMatrix> best = build();
    int cost = cost_of(best);
    for (bool better = true; better;) {
      better = false;
      for (char& decision : swapped_) {
        decision ^= 1;
        std::vector<SparseMatrix> other = build();
        const int other_cost = cost_of(other);
        if (other_cost < cost) {
          best = std::move(other);
          cost = other_cost;
          better = true;
        } else {
          decision ^= 1;
        }
      }
    }
    return best;
  }

 private:
  std::vector<SparseMatrix> build() {
    std::vector<SparseMatrix> parts;
    for (size_t p = 0; p < pairs_.size(); ++p) parts.push_back(part(p));
    return parts;
  }

  SparseMatrix part(size_t p) {
    const BlockPair pair = pairs_[p];
    const size_t rows = blocks_[pair.row].size(), cols = blocks_[pair.col].size();
    SparseMatrix result{static_cast<int>(rows), static_cast<int>(cols), {}, {}, {}};
    for (size_t j = 0; j < cols; ++j) {
      for (size_t i = 0; i < (pair.row == pair.col ? j + 1 : rows); ++i) {
        const Ref x = entry(p, i, j);
        if (!is_zero(builder_, x)) result.push(static_cast<int>(i), static_cast<int>(j), x);
      }
    }
    return result;
  }

  Ref entry(size_t p, size_t i, size_t j) {
    const BlockPair pair = pairs_[p];
    const size_t row = first_[pair.row] + i, col = first_[pair.col] + j;
    const int group = blocks_[pair.row][i].group;
    const Ref one = table_(row, col), other = table_(col, row);
    if (row != col && group >= 0 && group == blocks_[pair.col][j].group)
      return builder_.mul(mean_, builder_.add(one, other));
    return swapped_[3 * p + (i < j ? 0 : i == j ? 1 : 2)] ? other : one;
  }

  int cost_of(const std::vector<SparseMatrix>& parts) const {
    std::vector<Ref> roots;
    for (const SparseMatrix& m : parts) roots.insert(roots.end(), m.value.begin(), m.value.end());
    return estimated_cost(builder_.region(), roots);
  }

  Builder& builder_;
  const Table& table_;
  const std::vector<CoordinateBlock>& blocks_;
  const std::vector<BlockPair>& pairs_;
  std::vector<size_t> first_;  ///< of each block's coordinates in the table
  std::vector<char> swapped_;  ///< three decisions a pair
  Ref mean_;
};

}  // namespace

std::vector<SparseMatrix> hessian(Builder& builder, const WeightedSum& sum,
                                  const std::vector<CoordinateBlock>& blocks,
                                  const std::vector<BlockPair>& pairs) {
  std::vector<Coordinate> all;
  for (const CoordinateBlock& block : blocks) all.insert(all.end(), block.begin(), block.end());
  const Table table = iterate(builder, sum, all);
  return Chooser(builder, table, blocks, pairs).run();
}

SparseMatrix iterated_hessian(Builder& builder, const WeightedSum& sum,
                              const std::vector<Coordinate>& coordinates) {
  const Table table = iterate(builder, sum, coordinates);
  const int n = static_cast<int>(coordinates.size());
  SparseMatrix result{n, n, {}, {}, {}};
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const Ref x = table(static_cast<size_t>(i), static_cast<size_t>(j));
      if (!is_zero(builder, x)) result.push(i, j, x);
    }
  }
  return result;
}

}  // namespace arboc

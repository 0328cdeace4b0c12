// Each entry can be had in four ways: by a sweep along the column over the gradient, or by one back
// from the row's entry of it; and with rows and columns exchanged.  The way is one decision for
// each pair of blocks and each relation of the positions in them (before, same, behind), because
// the order of the joints in the tree says what a sweep has to pass through.  From each of the
// four, decisions are changed one by one as long as operations get fewer.  Finer decisions gain
// less than 1 %.
#include "derive/hessian.h"

#include <array>

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

/// By sweeps along the columns over the gradient.
Table by_columns(Builder& builder, const std::vector<Ref>& rows,
                 const std::vector<Coordinate>& coordinates) {
  const size_t n = coordinates.size();
  Table table{n, std::vector<Ref>(n * n)};
  ForwardSweep sweep(builder, rows, coordinates);
  for (size_t j = 0; j < n; ++j) {
    sweep.run(coordinates[j]);
    for (size_t i = 0; i < n; ++i) table.entry[i * n + j] = sweep[rows[i]];
  }
  return table;
}

/// By sweeps back from each entry of the gradient.
Table by_rows(Builder& builder, const std::vector<Ref>& rows,
              const std::vector<Coordinate>& coordinates) {
  Table table{coordinates.size(), {}};
  for (const Ref row : rows)
    for (const Ref x : gradient(builder, row, coordinates)) table.entry.push_back(x);
  return table;
}

/// Builds the parts in the way that takes the fewest operations.
class Chooser {
 public:
  Chooser(Builder& builder, const std::array<Table, 2>& tables,
          const std::vector<CoordinateBlock>& blocks, const std::vector<BlockPair>& pairs)
      : builder_(builder), tables_(tables), blocks_(blocks), pairs_(pairs) {
    size_t at = 0;
    for (const CoordinateBlock& block : blocks) {
      first_.push_back(at);
      at += block.size();
    }
    mean_ = builder.constant(0.5);
  }

  std::vector<SparseMatrix> run() {
    std::vector<SparseMatrix> best;
    int lowest = 0;
    for (char first = 0; first < kWays; ++first) {
      way_.assign(3 * pairs_.size(), first);
      const int cost = descend();
      if (first > 0 && cost >= lowest) continue;
      lowest = cost;
      best = build();
    }
    return best;
  }

 private:
  static constexpr char kWays = 4;  ///< table, then order

  /// Changes decisions one by one as long as operations get fewer; their number.
  int descend() {
    int cost = cost_of(build());
    for (bool better = true; better;) {
      better = false;
      for (char& way : way_) {
        const char before = way;
        char best = before;
        for (way = 0; way < kWays; ++way) {
          const int other = way == before ? cost : cost_of(build());
          if (other >= cost) continue;
          cost = other;
          best = way;
        }
        way = best;
        better = better || best != before;
      }
    }
    return cost;
  }

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
    const char way = way_[3 * p + (i < j ? 0 : i == j ? 1 : 2)];
    const Table& table = tables_[static_cast<size_t>(way / 2)];
    const Ref one = table(row, col), other = table(col, row);
    if (row != col && group >= 0 && group == blocks_[pair.col][j].group)
      return builder_.mul(mean_, builder_.add(one, other));
    return way % 2 == 0 ? one : other;
  }

  int cost_of(const std::vector<SparseMatrix>& parts) const {
    std::vector<Ref> roots;
    for (const SparseMatrix& m : parts) roots.insert(roots.end(), m.value.begin(), m.value.end());
    return estimated_cost(builder_.region(), roots);
  }

  Builder& builder_;
  const std::array<Table, 2>& tables_;
  const std::vector<CoordinateBlock>& blocks_;
  const std::vector<BlockPair>& pairs_;
  std::vector<size_t> first_;  ///< of each block's coordinates in the table
  std::vector<char> way_;      ///< three decisions a pair
  Ref mean_;
};

}  // namespace

std::vector<SparseMatrix> hessian(Builder& builder, const WeightedSum& sum,
                                  const std::vector<CoordinateBlock>& blocks,
                                  const std::vector<BlockPair>& pairs) {
  std::vector<Coordinate> all;
  for (const CoordinateBlock& block : blocks) all.insert(all.end(), block.begin(), block.end());
  const std::vector<Ref> rows = gradient(builder, sum, all);
  const std::array<Table, 2> tables{by_columns(builder, rows, all), by_rows(builder, rows, all)};
  return Chooser(builder, tables, blocks, pairs).run();
}

SparseMatrix iterated_hessian(Builder& builder, const WeightedSum& sum,
                              const std::vector<Coordinate>& coordinates) {
  const Table table = by_columns(builder, gradient(builder, sum, coordinates), coordinates);
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

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
    for (size_t p = 0; p < pairs.size(); ++p) list(p);
  }

  std::vector<SparseMatrix> run() {
    Ways best;
    int lowest = 0;
    for (size_t first = 0; first < kWays; ++first) {
      Ways ways;
      for (const Decision& d : decisions_) ways.push_back(d.same_as[first]);
      const int cost = descend(ways);
      if (first > 0 && cost >= lowest) continue;
      lowest = cost;
      best = ways;
    }
    return build(best);
  }

 private:
  static constexpr size_t kWays = 4;  ///< table, then order
  /// Of the positions in two blocks: before, same, behind.
  static constexpr size_t kRelations = 3;
  using Ways = std::vector<size_t>;  ///< one a decision

  /// How the entries of a pair are had whose positions have one relation.
  struct Decision {
    std::array<std::vector<Ref>, kWays> entries;  ///< those that are not zero
    std::array<size_t, kWays> same_as{};          ///< the first way with the same entries
  };

  /// Adds the decisions about a pair.
  void list(size_t p) {
    const size_t first = decisions_.size();
    decisions_.resize(first + kRelations);
    for (size_t way = 0; way < kWays; ++way)
      each(p, [&](size_t i, size_t j) {
        const Ref x = entry(p, i, j, way);
        if (!is_zero(builder_, x)) decisions_[first + relation(i, j)].entries[way].push_back(x);
      });
    for (size_t r = 0; r < kRelations; ++r) {
      Decision& d = decisions_[first + r];
      for (size_t way = 0; way < kWays; ++way)
        while (d.entries[d.same_as[way]] != d.entries[way]) ++d.same_as[way];
    }
  }

  /// Changes decisions one by one as long as operations get fewer; their number.
  int descend(Ways& ways) const {
    int cost = cost_of(ways);
    for (bool better = true; better;) {
      better = false;
      for (size_t d = 0; d < ways.size(); ++d) {
        size_t& way = ways[d];
        const size_t before = way;
        size_t best = before;
        for (way = 0; way < kWays; ++way) {
          if (way == before || decisions_[d].same_as[way] != way) continue;
          const int other = cost_of(ways);
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

  int cost_of(const Ways& ways) const {
    std::vector<Ref> roots;
    for (size_t d = 0; d < ways.size(); ++d) {
      const std::vector<Ref>& entries = decisions_[d].entries[ways[d]];
      roots.insert(roots.end(), entries.begin(), entries.end());
    }
    return estimated_cost(builder_.region(), roots);
  }

  std::vector<SparseMatrix> build(const Ways& ways) {
    std::vector<SparseMatrix> parts;
    for (size_t p = 0; p < pairs_.size(); ++p) {
      SparseMatrix& part = parts.emplace_back();
      part.rows = static_cast<int>(blocks_[pairs_[p].row].size());
      part.cols = static_cast<int>(blocks_[pairs_[p].col].size());
      each(p, [&](size_t i, size_t j) {
        const Ref x = entry(p, i, j, ways[kRelations * p + relation(i, j)]);
        if (!is_zero(builder_, x)) part.push(static_cast<int>(i), static_cast<int>(j), x);
      });
    }
    return parts;
  }

  static size_t relation(size_t i, size_t j) { return i < j ? 0 : i == j ? 1 : 2; }

  /// Calls visit(i, j) for the positions of a part that are written.
  template <class Visit>
  void each(size_t p, const Visit& visit) const {
    const BlockPair pair = pairs_[p];
    const size_t rows = blocks_[pair.row].size(), cols = blocks_[pair.col].size();
    for (size_t j = 0; j < cols; ++j)
      for (size_t i = 0; i < (pair.row == pair.col ? j + 1 : rows); ++i) visit(i, j);
  }

  Ref entry(size_t p, size_t i, size_t j, size_t way) {
    const BlockPair pair = pairs_[p];
    const size_t row = first_[pair.row] + i, col = first_[pair.col] + j;
    const int group = blocks_[pair.row][i].group;
    const Table& table = tables_[way / 2];
    const Ref one = table(row, col), other = table(col, row);
    if (row != col && group >= 0 && group == blocks_[pair.col][j].group)
      return builder_.mul(mean_, builder_.add(one, other));
    return way % 2 == 0 ? one : other;
  }

  Builder& builder_;
  const std::array<Table, 2>& tables_;
  const std::vector<CoordinateBlock>& blocks_;
  const std::vector<BlockPair>& pairs_;
  std::vector<size_t> first_;        ///< of each block's coordinates in the table
  std::vector<Decision> decisions_;  ///< one a relation of each pair
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

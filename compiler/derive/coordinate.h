// By what derivatives are taken, and the form in which they come.
//
// A coordinate is a direction in which the inputs of a graph may move; it need not be an input.
// Seeds say how nodes change with it: usually one input by 1, but a turning body moves all four
// entries of a quaternion, and what it does to the entries of the rotation matrix made of them is
// simpler than the chain rule finds:
//   seeds of a turn about the body's x axis:  R_xy changes by R_xz, R_xz by -R_xy, ...
//
// A node that any of the requested coordinates seeds is a barrier for all of them: its derivative
// is what the coordinate's seed says, zero if the coordinate does not list it, and its operands are
// not looked at.  So a list of coordinates is valid if for each seeded node and each coordinate
// that does not seed it the derivative is zero indeed.  Paths to the inputs around a barrier stay
// open.
#pragma once
#include <string>
#include <vector>

#include "graph/builder.h"

namespace arboc {

/// The node changes by `derivative` when the coordinate changes by one.
struct Seed {
  Ref node;
  Ref derivative;
};

struct Coordinate {
  std::string name;  ///< for titles of blocks
  std::vector<Seed> seeds;
  /// Coordinates of one joint whose moves do not commute have the same group; -1: commutes with
  /// all.
  int group = -1;
};

/// One coordinate an input, named `name`0, `name`1, ...
std::vector<Coordinate> coordinates_of(Builder& builder, const std::string& name,
                                       const std::vector<Ref>& inputs);

/// sum_i weight_i y_i, all of whose derivatives are wanted.
struct WeightedSum {
  std::vector<Ref> terms;    ///< y
  std::vector<Ref> weights;  ///< as many
};

/// The structural non-zeros, by columns and in each of them by rows.
struct SparseMatrix {
  int rows = 0, cols = 0;
  std::vector<int> row, col;
  std::vector<Ref> value;

  void push(int i, int j, Ref x) {
    row.push_back(i);
    col.push_back(j);
    value.push_back(x);
  }
  /// Rows r0 to r1 and columns c0 to c1, the ends not included.
  SparseMatrix part(int r0, int r1, int c0, int c1) const {
    SparseMatrix out{r1 - r0, c1 - c0, {}, {}, {}};
    for (size_t k = 0; k < value.size(); ++k)
      if (r0 <= row[k] && row[k] < r1 && c0 <= col[k] && col[k] < c1)
        out.push(row[k] - r0, col[k] - c0, value[k]);
    return out;
  }
};

}  // namespace arboc

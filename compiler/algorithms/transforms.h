// Homogeneous transforms of frames and their derivatives: q -> T, its inverse, dT, d2T, d3T.
//
// With the twist (l, w) of a coordinate along the world's axes, a derivative of T = [R p; 0 1] is a
// product of twists and T in the order of the joints, which is to say of cross products: the first
// is (w x R, w x (p - x) + l) for an axis through x, each further one w x its columns.  Within a
// joint of several freedoms the mean over all orders is taken: derivatives along q (+) d.  Only
// entries j <= k <= l are formed.  docs/theory.md section 11.
#pragma once
#include <algorithm>

#include "algorithms/placement.h"
#include "algorithms/twist.h"

namespace arboc {

template <class T>
struct TransformsWorkspace {
  Placements<T> placement;

  template <class Tree>
  explicit TransformsWorkspace(const Tree& tree) : placement(tree) {}
};

/// The upper three rows of a 4x4 matrix; of derivatives the fourth is zero.
template <class T>
struct AffineColumns {
  Vector3<T> c[4];
};

/// What one coordinate does to a frame: a direction of a joint between it and the world.
template <class T>
struct ChainStep {
  int body, coordinate;
  double multiplier;
  Vector3<T> w;            ///< along the world's axes
  AffineColumns<T> first;  ///< derivative of the transform
};

/// A further derivative, along a coordinate of a joint nearer to the world.
template <class T>
AffineColumns<T> turned_by(const ChainStep<T>& s, const AffineColumns<T>& X) {
  return {{cross(s.w, X.c[0]), cross(s.w, X.c[1]), cross(s.w, X.c[2]), cross(s.w, X.c[3])}};
}

template <class T>
AffineColumns<T> mean(double weight, const AffineColumns<T>& a, const AffineColumns<T>& b) {
  AffineColumns<T> sum;
  for (int i = 0; i < 4; ++i) sum.c[i] = weight * (a.c[i] + b.c[i]);
  return sum;
}

/// Steps a, b (and c) from the world to the frame.
template <class T>
AffineColumns<T> second(const ChainStep<T>& a, const ChainStep<T>& b) {
  const AffineColumns<T> X = turned_by(a, b.first);
  return a.body != b.body || &a == &b ? X : mean(0.5, X, turned_by(b, a.first));
}
template <class T>
AffineColumns<T> third(const ChainStep<T>& a, const ChainStep<T>& b, const ChainStep<T>& c) {
  const AffineColumns<T> X = turned_by(a, second(b, c));
  if (a.body != b.body || (&a == &b && &b == &c)) return X;
  if (b.body != c.body) return &a == &b ? X : mean(0.5, X, turned_by(b, second(a, c)));
  AffineColumns<T> sum = mean(1.0, X, turned_by(b, second(a, c)));
  return mean(1.0 / 3, sum, turned_by(c, second(a, b)));
}

/// Blocks of four columns of a row-major matrix with four rows a frame.
template <class T>
struct AffineBlocks {
  T* rows = nullptr;  ///< the frame's first
  int blocks = 1;

  T& operator()(int row, int block, int column) const {
    return rows[(row * blocks + block) * 4 + column];
  }
  void add(int block, double factor, const AffineColumns<T>& X) const {
    for (int column = 0; column < 4; ++column)
      for (int row = 0; row < 3; ++row) {
        T& entry = (*this)(row, block, column);
        entry = entry + factor * X.c[column][row];
      }
  }
};

/// Among sorted coordinates; blocks of pairs j <= k and of triples j <= k <= l.
inline int pair_block(int j, int k) { return k * (k + 1) / 2 + j; }
inline int triple_block(int j, int k, int l) {
  return l * (l + 1) * (l + 2) / 6 + pair_block(j, k);
}

/// How often a set of steps stands in the sums behind an entry: once an order in which their
/// coordinates are sorted.
template <class T>
double orders(const ChainStep<T>& a, const ChainStep<T>& b) {
  return a.coordinate == b.coordinate && &a != &b ? 2 : 1;
}
template <class T>
double orders(const ChainStep<T>& a, const ChainStep<T>& b, const ChainStep<T>& c) {
  if (a.coordinate == b.coordinate && b.coordinate == c.coordinate) {
    const int same = (&a == &b) + (&b == &c);
    return same == 0 ? 6 : same == 1 ? 3 : 1;
  }
  return orders(a, b) * orders(b, c) * orders(a, c);
}

/// Where a frame is, and all that moves it.
template <class Tree, class T>
std::vector<ChainStep<T>> chain_steps(const Tree& tree, const Placements<T>& placement, int f,
                                      AffineColumns<T>& at) {
  const auto& frame = tree.frame[f];
  const auto& own = placement[frame.body];
  for (int i = 0; i < 3; ++i) at.c[i] = turned(own.row, cast<T>(column(frame.R, i)));
  at.c[3] = frame_origin(frame, own);
  std::vector<ChainStep<T>> steps;
  const Vector3<T> zero{T(0), T(0), T(0)};
  for (int k = frame.body; k != 0; k = tree.body[k].parent) {
    const auto& body = tree.body[k];
    for (int d = freedoms(body.motion) - 1; d >= 0; --d) {
      const int c = component(body.motion, d);
      const Vector3<T> z = axis(placement[k].row, c % 3);
      if (c < 3) {
        steps.push_back({k, body.v + d, body.multiplier, zero, {{zero, zero, zero, z}}});
        continue;
      }
      steps.push_back({k,
                       body.v + d,
                       body.multiplier,
                       z,
                       {{cross(z, at.c[0]), cross(z, at.c[1]), cross(z, at.c[2]),
                         cross(z, at.c[3] - placement[k].x)}}});
    }
  }
  std::reverse(steps.begin(), steps.end());
  return steps;
}

/// The frame's blocks of second and third derivatives.
template <class T>
void write_second(const std::vector<ChainStep<T>>& steps, const AffineBlocks<T>& out) {
  for (size_t i = 0; i < steps.size(); ++i)
    for (size_t j = i; j < steps.size(); ++j) {
      const ChainStep<T>&a = steps[i], &b = steps[j];
      const int low = std::min(a.coordinate, b.coordinate);
      out.add(pair_block(low, std::max(a.coordinate, b.coordinate)),
              orders(a, b) * a.multiplier * b.multiplier, second(a, b));
    }
}
template <class T>
void write_third(const std::vector<ChainStep<T>>& steps, const AffineBlocks<T>& out) {
  for (size_t i = 0; i < steps.size(); ++i)
    for (size_t j = i; j < steps.size(); ++j)
      for (size_t k = j; k < steps.size(); ++k) {
        const ChainStep<T>&a = steps[i], &b = steps[j], &c = steps[k];
        int at[] = {a.coordinate, b.coordinate, c.coordinate};
        std::sort(at, at + 3);
        out.add(triple_block(at[0], at[1], at[2]),
                orders(a, b, c) * a.multiplier * b.multiplier * c.multiplier, third(a, b, c));
      }
}

/// q (nq) -> out[0] T and out[1] its inverse, 4 rows a frame; out[order + 1] the derivatives of
/// `order` 1 to `last`, four columns a coordinate, pair j <= k or triple j <= k <= l.
template <class Tree, class T>
void transforms(const Tree& tree, TransformsWorkspace<T>& work, const T* q,
                const std::vector<int>& frames, int last, T* const* out) {
  work.placement.update(tree, q);
  const int n = tree.nv, pairs = pair_block(0, n), triples = triple_block(0, 0, n);
  for (size_t f = 0; f < frames.size(); ++f) {
    enter_block(q, tree.frame[frames[f]].name, "transform");
    const auto rows = [&](int k, int blocks) {
      return AffineBlocks<T>{out[k] + 16 * static_cast<int>(f) * blocks, blocks};
    };
    AffineColumns<T> at;
    const std::vector<ChainStep<T>> steps = chain_steps(tree, work.placement, frames[f], at);
    rows(0, 1).add(0, 1, at);
    AffineColumns<T> back;
    for (int i = 0; i < 3; ++i) {
      back.c[i] = {at.c[0][i], at.c[1][i], at.c[2][i]};
      back.c[3][i] = T(0) - dot(at.c[i], at.c[3]);
    }
    rows(1, 1).add(0, 1, back);
    rows(0, 1)(3, 0, 3) = rows(1, 1)(3, 0, 3) = T(1);
    if (last < 1) continue;
    for (const ChainStep<T>& s : steps) rows(2, n).add(s.coordinate, s.multiplier, s.first);
    if (last > 1) write_second(steps, rows(3, pairs));
    if (last > 2) write_third(steps, rows(4, triples));
  }
}

}  // namespace arboc

// The traced scalar: an algorithm template run with T = Expr records what it would compute.
//
// An Expr is a constant that belongs to no graph, or a reference into the region that a Builder
// makes; so are constants that differ between lanes.  There is no global state: the builder travels
// with the values.
#pragma once
#include <string>
#include <vector>

#include "graph/builder.h"

namespace arboc {

class Expr {
 public:
  Expr() = default;
  Expr(double value) : value_(value) {}  // NOLINT: constants of the model enter expressions
  Expr(Builder* builder, Ref ref);

  bool is_constant() const { return builder_ == nullptr; }
  /// Of a constant.
  double value() const { return value_; }
  Builder* builder() const { return builder_; }
  /// The reference in `builder`, into which a constant is interned.
  Ref ref(Builder& builder) const { return builder_ ? ref_ : builder.constant(value_); }

  Expr operator-() const;
  friend Expr operator+(const Expr& a, const Expr& b);
  friend Expr operator-(const Expr& a, const Expr& b) { return a + -b; }
  friend Expr operator*(const Expr& a, const Expr& b);
  friend Expr operator/(const Expr& a, const Expr& b);
  Expr& operator+=(const Expr& b) { return *this = *this + b; }
  Expr& operator-=(const Expr& b) { return *this = *this - b; }
  Expr& operator*=(const Expr& b) { return *this = *this * b; }

 private:
  Builder* builder_ = nullptr;
  Ref ref_;
  double value_ = 0;
};

Expr sqrt(const Expr& x);
void sincos(const Expr& x, Expr& s, Expr& c);
Expr stumpff(int k, const Expr& x);
Expr quaternion_log(const Expr& w);
Expr log_curvature(const Expr& w);
/// Scalars of one builder side by side, and back: Builder::pack, lane, hsum.
Expr pack(Builder& builder, const std::vector<Expr>& scalars);
Expr lane(const Expr& x, int k);
Expr hsum(const Expr& x, int n);
/// As the runtime spells it, for the algorithms.
template <int k>
Expr stumpff(const Expr& x) {
  return stumpff(k, x);
}

/// True where x is known to be zero for every input, so that work on it can be left out.
inline bool is_zero(const Expr& x) { return x.is_constant() && x.value() == 0; }
inline bool is_zero(double) { return false; }

/// The same questions of a number of the model that may be a parameter.
inline bool vanishes(const Expr& x) { return is_zero(x); }
inline bool coincide(const Expr& x, const Expr& y) {
  if (x.is_constant() && y.is_constant()) return x.value() == y.value();
  return !x.is_constant() && !y.is_constant() && x.ref(*x.builder()) == y.ref(*y.builder());
}

/// Titles the nodes made from now on; `inputs` points to any traced input.
void enter_block(const Expr* inputs, const std::string& subject, const char* phase);
/// The nodes made from now on come behind those made before.
void next_step(const Expr* inputs);

}  // namespace arboc

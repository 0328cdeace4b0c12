#include "graph/expr.h"

#include <cmath>

#include "base/exact_trig.h"

namespace arboc {
namespace {

/// A constant that enters generated code must not depend on the machine's libm.
SinCos constant_sincos(double x) {
  if (std::fabs(x) < 1e9) return exact_sincos(x);
  return {std::sin(x), std::cos(x)};
}

}  // namespace

Expr::Expr(Builder* builder, Ref ref) {
  if (builder->region().is_constant(ref) && builder->region()[ref].width == 1) {
    value_ = builder->region().value(ref);
  } else {
    builder_ = builder;
    ref_ = ref;
  }
}

Expr Expr::operator-() const {
  Expr result = *this;
  result.ref_ = -ref_;
  result.value_ = value_ == 0 ? 0.0 : -value_;
  return result;
}

Expr operator+(const Expr& a, const Expr& b) {
  if (a.is_constant() && b.is_constant()) return a.value_ + b.value_;
  Builder& builder = *(a.builder_ ? a.builder_ : b.builder_);
  return {&builder, builder.add(a.ref(builder), b.ref(builder))};
}

Expr operator*(const Expr& a, const Expr& b) {
  if (a.is_constant() && b.is_constant()) return a.value_ * b.value_;
  Builder& builder = *(a.builder_ ? a.builder_ : b.builder_);
  return {&builder, builder.mul(a.ref(builder), b.ref(builder))};
}

Expr operator/(const Expr& a, const Expr& b) {
  if (a.is_constant() && b.is_constant()) return a.value_ / b.value_;
  Builder& builder = *(a.builder_ ? a.builder_ : b.builder_);
  return {&builder, builder.div(a.ref(builder), b.ref(builder))};
}

Expr sqrt(const Expr& x) {
  if (x.is_constant()) return std::sqrt(x.value());
  return {x.builder(), x.builder()->sqrt(x.ref(*x.builder()))};
}

void sincos(const Expr& x, Expr& s, Expr& c) {
  if (x.is_constant()) {
    const SinCos value = constant_sincos(x.value());
    s = value.sin;
    c = value.cos;
    return;
  }
  Builder& builder = *x.builder();
  const Ref angle = x.ref(builder);
  s = {&builder, builder.sin(angle)};
  c = {&builder, builder.cos(angle)};
}

Expr stumpff(int k, const Expr& x) {
  if (x.is_constant()) return special_value(Op::kStumpff, k, x.value());
  return {x.builder(), x.builder()->stumpff(k, x.ref(*x.builder()))};
}

Expr quaternion_log(const Expr& w) {
  if (w.is_constant()) return special_value(Op::kQuaternionLog, 0, w.value());
  return {w.builder(), w.builder()->quaternion_log(w.ref(*w.builder()))};
}

Expr log_curvature(const Expr& w) {
  if (w.is_constant()) return special_value(Op::kLogCurvature, 0, w.value());
  return {w.builder(), w.builder()->log_curvature(w.ref(*w.builder()))};
}

Expr pack(Builder& builder, const std::vector<Expr>& scalars) {
  std::vector<Ref> refs;
  for (const Expr& x : scalars) refs.push_back(x.ref(builder));
  return {&builder, builder.pack(refs)};
}

Expr lane(const Expr& x, int k) {
  if (x.is_constant()) return x;
  return {x.builder(), x.builder()->lane(x.ref(*x.builder()), k)};
}

Expr hsum(const Expr& x, int n) {
  if (x.is_constant()) return n * x.value();
  return {x.builder(), x.builder()->hsum(x.ref(*x.builder()), n)};
}

void enter_block(const Expr* inputs, const std::string& subject, const char* phase) {
  if (inputs->builder()) inputs->builder()->begin_block(subject + ", " + phase);
}

void next_step(const Expr* inputs) {
  if (inputs->builder()) inputs->builder()->next_step();
}

}  // namespace arboc

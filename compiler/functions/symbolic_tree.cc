#include "functions/symbolic_tree.h"

namespace arboc {
namespace {

/// Where symbols leave a number alone it is the one of the tree of numbers, whose rounding is
/// cleaned.
void keep_number(double number, Expr& x) {
  if (x.is_constant()) x = number;
}
void keep_numbers(const Vector3<double>& numbers, Vector3<Expr>& x) {
  for (int k = 0; k < 3; ++k) keep_number(numbers[k], x[k]);
}

}  // namespace

DynamicTreeOf<Expr> symbolic_tree(const Setup& setup, const LoweringOptions& lowering,
                                  const DynamicTree& nominal, const Arguments<Expr>& inputs) {
  DynamicTreeOf<Expr> tree = lower(setup.model, lowering,
                                   numbers_with(setup.model, setup.joint_forces, setup.parameters,
                                                parameter_values(setup, inputs)));
  keep_numbers(nominal.gravity, tree.gravity);
  for (size_t k = 0; k < tree.body.size(); ++k) {
    const BodyOf<double>& from = nominal.body[k];
    BodyOf<Expr>& to = tree.body[k];
    keep_numbers(from.c, to.c);
    keep_number(from.inertia.m, to.inertia.m);
    keep_numbers(from.inertia.h, to.inertia.h);
    const Symmetric3<double>& I = from.inertia.Sigma;
    Symmetric3<Expr>& S = to.inertia.Sigma;
    keep_number(I.xx, S.xx);
    keep_number(I.yy, S.yy);
    keep_number(I.zz, S.zz);
    keep_number(I.xy, S.xy);
    keep_number(I.xz, S.xz);
    keep_number(I.yz, S.yz);
  }
  for (size_t k = 0; k < tree.frame.size(); ++k) keep_numbers(nominal.frame[k].p, tree.frame[k].p);
  return tree;
}

}  // namespace arboc

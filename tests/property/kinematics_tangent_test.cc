// integrate and difference, their derivatives, and every function traced.
#include "graph/expr.h"
#include "passes/passes.h"
#include "property/kinematics_cases.h"

namespace arboc::test {
namespace {

VectorXd moved(const DynamicTree& tree, const VectorXd& q, const VectorXd& v) {
  return vector_of(run_other<double>("integrate", tree, {list(q), list(v), {}, {}}));
}
VectorXd apart(const DynamicTree& tree, const VectorXd& q0, const VectorXd& q1) {
  return vector_of(run_other<double>("difference", tree, {list(q0), {}, {}, list(q1)}));
}

/// Displacements of different size: rotations up to 2 sqrt(3) scale.
template <class Check>
void for_each_displacement(Check check) {
  for_each_case(10, [&](const KinematicCase& c) {
    for (const double scale : {0.0, 1e-8, 1e-3, 0.1, 0.9}) check(c, VectorXd(scale * c.state.v));
  });
}

TEST(Tangent, IntegrateIsTheReferences) {
  for_each_displacement([](const KinematicCase& c, const VectorXd& v) {
    EXPECT_LT(distance(moved(c.tree, c.state.q, v), c.reference.integrate(c.state.q, v)), 1e-14);
    const VectorXd far = 20 * v;
    EXPECT_LT(distance(moved(c.tree, c.state.q, far), c.reference.integrate(c.state.q, far)),
              1e-12);  // angles up to 60: the recursions between c_k multiply by angles
  });
}

TEST(Tangent, DifferenceInvertsIntegrate) {
  for_each_displacement([](const KinematicCase& c, const VectorXd& v) {
    VectorXd q1 = moved(c.tree, c.state.q, v);
    EXPECT_LT(distance(apart(c.tree, c.state.q, q1), v), 1e-13);
    for (const Body& body : c.tree.body)  // the same rotation
      if (body.motion == Motion::kFloating) q1.segment(body.q + 3, 4) *= -1;
    EXPECT_LT(distance(apart(c.tree, c.state.q, q1), v), 1e-13);
  });
}

TEST(Tangent, DerivativesAreThoseOfDifferences) {
  for_each_displacement([](const KinematicCase& c, const VectorXd& v) {
    const int n = c.tree.nv;
    const VectorXd q0 = c.state.q, q1 = moved(c.tree, q0, v);
    const auto moves =
        run_other<double>("integrate_derivatives", c.tree, {list(q0), list(v), {}, {}});
    const auto ways =
        run_other<double>("difference_derivatives", c.tree, {list(q0), {}, {}, list(q1)});
    for (int k = 0; k < n; ++k) {
      const auto step = [&](double t) { return VectorXd(t * VectorXd::Unit(n, k)); };
      const auto column = [&](const std::vector<double>& x, int first) {
        return MatrixXd(matrix_of(x, n, n, first).col(k));
      };
      const auto start = [&](double t) { return moved(c.tree, q0, step(t)); };
      const auto end = [&](double t) { return moved(c.tree, q1, step(t)); };
      const VectorXd expected[] = {
          derivative([&](double t) { return apart(c.tree, q1, moved(c.tree, start(t), v)); }),
          derivative([&](double t) { return apart(c.tree, q1, moved(c.tree, q0, v + step(t))); }),
          derivative([&](double t) { return apart(c.tree, start(t), q1); }),
          derivative([&](double t) { return apart(c.tree, q0, end(t)); })};
      EXPECT_LT(distance(column(moves, 0), expected[0]), kDifferences) << k;
      EXPECT_LT(distance(column(moves, n * n), expected[1]), kDifferences) << k;
      EXPECT_LT(distance(column(ways, 0), expected[2]), kDifferences) << k;
      EXPECT_LT(distance(column(ways, n * n), expected[3]), kDifferences) << k;
    }
  });
}

TEST(Tangent, DerivativesOfDifferenceInvertThoseOfIntegrate) {
  for_each_displacement([](const KinematicCase& c, const VectorXd& v) {
    const int n = c.tree.nv;
    const VectorXd q1 = moved(c.tree, c.state.q, v);
    const auto moves =
        run_other<double>("integrate_derivatives", c.tree, {list(c.state.q), list(v), {}, {}});
    const auto ways =
        run_other<double>("difference_derivatives", c.tree, {list(c.state.q), {}, {}, list(q1)});
    const MatrixXd by_v = matrix_of(moves, n, n, n * n), by_q = matrix_of(moves, n, n);
    const MatrixXd by_q1 = matrix_of(ways, n, n, n * n), by_q0 = matrix_of(ways, n, n);
    EXPECT_LT(distance(by_q1 * by_v, MatrixXd::Identity(n, n)), 1e-12);
    EXPECT_LT(distance(by_q1 * by_q, -by_q0), 1e-12);
  });
}

/// Runs `use` on traced inputs, and its graph on those of the case.
template <class Use>
std::vector<double> through_graph(const KinematicInputs<double>& in, Use use) {
  Builder builder("f");
  const auto port = [&](const char* name, const std::vector<double>& values) {
    std::vector<Expr> out;
    for (const Ref ref : builder.input(name, static_cast<int>(values.size())))
      out.emplace_back(&builder, ref);
    return out;
  };
  const KinematicInputs<Expr> traced{port("q", in.q), port("v", in.v), port("a", in.a),
                                     port("p", in.q1)};
  std::vector<Ref> out;
  for (const Expr& x : use(traced)) out.push_back(x.ref(builder));
  builder.output("y", out);
  return evaluate(run_passes(std::move(builder).finish()), {in.q, in.v, in.a, in.q1})[0];
}

TEST(Traced, FunctionsAreTheGenericOnes) {
  for_each_case(4, [](const KinematicCase& c) {
    KinematicInputs<double> in = c.at();
    in.q1 = list(c.reference.integrate(c.state.q, 0.3 * c.state.a));
    const auto compare = [&](const std::string& name, auto use) {
      EXPECT_LT(distance(vector_of(through_graph(in, use)), vector_of(use(in))), kRounding) << name;
    };
    for (const std::string& name : kOtherFunctions)
      compare(name, [&](const auto& x) { return run_other(name, c.tree, x); });
    const int last = c.all_frames().back();
    for (const std::string& name : kFrameFunctions)
      for (const Axes axes : {Axes::kLocal, Axes::kWorld, Axes::kAligned})
        for (const auto& frames : {c.all_frames(), std::vector<int>{last}})
          compare(name, [&](const auto& x) { return run_frames(name, c.tree, x, frames, axes); });
  });
}

}  // namespace
}  // namespace arboc::test

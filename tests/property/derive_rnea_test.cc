// Derivatives of traced inverse dynamics in the tangent of the configuration: gradients of
// lambda . tau against the recursion rnea_derivatives, Hessians against differences of it along the
// reference engine's (+), and against Pinocchio's recorded second-order tensors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "compile.h"
#include "derive/hessian.h"
#include "derive/jacobian.h"
#include "derive/reverse.h"
#include "frontend/urdf.h"
#include "functions/tangent.h"
#include "functions/trace.h"
#include "graph/expr.h"
#include "reference/reference.h"
#include "support/oracle.h"
#include "support/random_model.h"
#include "support/random_state.h"
#include "tree/lower.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-12;    // of sums over a tree, relative to the largest entry
constexpr double kDifferences = 1e-9;  // the stencil's own error, see reference/differences.h
constexpr double kPinocchio = 1e-10;   // what the recorded tensors state for themselves

struct Kind {
  const char* name;
  RandomModelOptions options;
};
const Kind kKinds[] = {
    {"fixed base, every joint", {7}},
    {"floating base, every joint", {7, Base::kFloating}},
    {"fixed base, single joints", {7, Base::kFixed, false, false}},
};

template <class Check>
void for_each_case(Check check) {
  for (const Kind& kind : kKinds)
    for (const std::uint64_t seed : seeds(8)) {
      SCOPED_TRACE(std::string(kind.name) + ", ARBOC_SEED=" + std::to_string(seed));
      const Model model = random_model(seed, kind.options);
      Random random(seed + 2000);
      const State state = random_state(model, random);
      if (state.v.size() > 0)
        check(model, state, random.vector(static_cast<int>(state.v.size()), 1));
    }
}

std::vector<double> list(const VectorXd& x) { return {x.begin(), x.end()}; }

VectorXd vector_of(const std::vector<double>& x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// lambda . tau(q, v, a) as a graph, and what to differentiate it by.
struct Problem {
  Builder builder{"f"};
  std::vector<Ref> q, v, a;
  WeightedSum sum;
  CoordinateBlock by_q, by_v, by_a;

  explicit Problem(const DynamicTree& tree) {
    q = builder.input("q", tree.nq);
    v = builder.input("v", tree.nv);
    a = builder.input("a", tree.nv);
    sum.weights = builder.input("lambda", tree.nv);
    std::vector<Expr> tau(static_cast<size_t>(tree.nv));
    RneaWorkspace<Expr> work(tree);
    rnea(tree, work, traced(q).data(), traced(v).data(), traced(a).data(), tau.data());
    for (const Expr& x : tau) sum.terms.push_back(x.ref(builder));
    by_q = tangent(tree, builder, q);
    by_v = coordinates_of(builder, "v", v);
    by_a = coordinates_of(builder, "a", a);
  }
  std::vector<Expr> traced(const std::vector<Ref>& refs) {
    std::vector<Expr> out;
    for (const Ref ref : refs) out.emplace_back(&builder, ref);
    return out;
  }
  CoordinateBlock all() const {
    CoordinateBlock out = by_q;
    out.insert(out.end(), by_v.begin(), by_v.end());
    out.insert(out.end(), by_a.begin(), by_a.end());
    return out;
  }
};

VectorXd evaluate_at(const Graph& graph, const State& s, const VectorXd& lambda) {
  return vector_of(evaluate(graph, {list(s.q), list(s.v), list(s.a), list(lambda)})[0]);
}

/// The entries of a matrix, dense.
MatrixXd evaluate_at(Builder builder, const SparseMatrix& matrix, const State& s,
                     const VectorXd& lambda) {
  builder.output("m", matrix.value);
  const VectorXd entries = evaluate_at(std::move(builder).finish(), s, lambda);
  MatrixXd out = MatrixXd::Zero(matrix.rows, matrix.cols);
  for (size_t e = 0; e < matrix.value.size(); ++e)
    out(matrix.row[e], matrix.col[e]) = entries[static_cast<Eigen::Index>(e)];
  return out;
}

MatrixXd square(const std::vector<double>& values, int n) {
  return Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(values.data(), n, n);
}

/// Derivatives of lambda . tau by q, v, a, from the recursion.
VectorXd expected_gradient(const DynamicTree& tree, const State& s, const VectorXd& lambda) {
  const int n = tree.nv;
  RneaDerivativesWorkspace<double> work(tree);
  std::vector<double> dq(static_cast<size_t>(n) * static_cast<size_t>(n)), dv = dq, M = dq;
  rnea_derivatives(tree, work, s.q.data(), s.v.data(), s.a.data(),
                   SquareMatrix<double>{dq.data(), n}, SquareMatrix<double>{dv.data(), n},
                   UpperTriangle<double>{M.data(), n});
  const MatrixXd upper = square(M, n);
  VectorXd g(3 * n);
  g << square(dq, n).transpose() * lambda, square(dv, n).transpose() * lambda,
      upper.selfadjointView<Eigen::Upper>() * lambda;
  return g;
}

double distance(const MatrixXd& a, const MatrixXd& b) {
  if (a.size() == 0) return 0;
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

TEST(TracedDerivatives, GradientIsThatOfTheRecursion) {
  double worst = 0;
  for_each_case([&](const Model& model, const State& state, const VectorXd& lambda) {
    for (const LoweringOptions& lowering : lowerings("rnea")) {
      const DynamicTree tree = lower(model, lowering);
      Problem p(tree);
      p.builder.output("g", gradient(p.builder, p.sum, p.all()));
      const VectorXd g = evaluate_at(std::move(p.builder).finish(), state, lambda);
      const double error = distance(g, expected_gradient(tree, state, lambda));
      EXPECT_LE(error, kRounding);
      worst = std::max(worst, error);
    }
  });
  RecordProperty("worst", fmt::format("{:.1e}", worst));
}

/// Column j: change of the gradient along coordinate j, six points.
MatrixXd differences(const Model& model, const DynamicTree& tree, const State& state,
                     const VectorXd& lambda) {
  double fastest = 1;
  for (const Coordinates::Entry& entry : coordinates(model).joint)
    fastest = std::max(fastest, std::fabs(entry.multiplier));
  const double h = 0.01 / fastest;
  const Reference reference(model);
  const int n = tree.nv;
  MatrixXd H(3 * n, 3 * n);
  for (int j = 0; j < 3 * n; ++j) {
    const auto at = [&](double d) {
      State s = state;
      const VectorXd step = d * VectorXd::Unit(n, j % n);
      if (j < n) s.q = reference.integrate(state.q, step);
      if (j >= n && j < 2 * n) s.v += step;
      if (j >= 2 * n) s.a += step;
      return expected_gradient(tree, s, lambda);
    };
    const auto odd = [&](int k) -> VectorXd { return at(k * h) - at(-k * h); };
    H.col(j) = (45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h);
  }
  return H;
}

TEST(TracedDerivatives, HessianIsThatOfDifferences) {
  double worst = 0, worst_symmetric = 0;
  for_each_case([&](const Model& model, const State& state, const VectorXd& lambda) {
    const DynamicTree tree = lower(model, lowerings("rnea")[1]);
    const Eigen::Index n = tree.nv;
    Problem p(tree);
    const SparseMatrix iterated = iterated_hessian(p.builder, p.sum, p.all());
    const MatrixXd expected = differences(model, tree, state, lambda);
    worst = std::max(worst, distance(evaluate_at(p.builder, iterated, state, lambda), expected));
    EXPECT_LE(worst, kDifferences);

    const MatrixXd full = (expected + expected.transpose()) / 2;
    const auto H = hessian(p.builder, p.sum, {p.by_q, p.by_v, p.by_a},
                           {{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}});
    const MatrixXd parts[] = {
        full.topLeftCorner(n, n).triangularView<Eigen::Upper>(), full.block(0, n, n, n),
        full.block(n, n, n, n).triangularView<Eigen::Upper>(), full.topRightCorner(n, n)};
    for (size_t k = 0; k < 4; ++k) {
      const double error = distance(evaluate_at(p.builder, H[k], state, lambda), parts[k]);
      EXPECT_LE(error, kDifferences) << k;
      worst_symmetric = std::max(worst_symmetric, error);
    }
    EXPECT_TRUE(H[4].value.empty());
    EXPECT_TRUE(H[5].value.empty());
  });
  RecordProperty("worst", fmt::format("{:.1e}", std::max(worst, worst_symmetric)));
}

/// A seed an input, or the entries of a rotation and of what it moves.
TEST(Tangent, SeedsAndGroups) {
  for_each_case([](const Model& model, const State&, const VectorXd&) {
    const DynamicTree tree = lower(model, lowerings("rnea")[0]);
    Builder builder("f");
    const std::vector<Coordinate> by = tangent(tree, builder, builder.input("q", tree.nq));
    ASSERT_EQ(by.size(), static_cast<size_t>(tree.nv));
    for (size_t i = 1; i < tree.body.size(); ++i) {
      const Motion motion = tree.body[i].motion;
      for (int d = 0; d < freedoms(motion); ++d) {
        const Coordinate& c = by[static_cast<size_t>(tree.body[i].v + d)];
        EXPECT_EQ(c.group >= 0, freedoms(motion) > 1);
        const size_t expected = motion == Motion::kPlanar     ? (d == 2 ? 1 : 2)
                                : motion == Motion::kFloating ? (d < 3 ? 3 : 10)
                                                              : 1;
        EXPECT_EQ(c.seeds.size(), expected);
      }
    }
  });
}

/// The inputs themselves as functions: what q (+) d does to every entry of q, quaternions included.
TEST(Tangent, MovesEveryInputAsTheReferenceDoes) {
  for_each_case([](const Model& model, const State& state, const VectorXd&) {
    const DynamicTree tree = lower(model, lowerings("rnea")[0]);
    const Reference reference(model);
    Builder builder("f");
    const std::vector<Ref> q = builder.input("q", tree.nq);
    const SparseMatrix J = jacobian(builder, q, tangent(tree, builder, q));
    builder.output("J", J.value);
    const auto entries = evaluate(std::move(builder).finish(), {list(state.q)})[0];
    MatrixXd got = MatrixXd::Zero(tree.nq, tree.nv), expected = got;
    for (size_t e = 0; e < entries.size(); ++e) got(J.row[e], J.col[e]) = entries[e];
    for (int j = 0; j < tree.nv; ++j) {
      const auto odd = [&](double h) -> VectorXd {
        const VectorXd step = h * VectorXd::Unit(tree.nv, j);
        return reference.integrate(state.q, step) - reference.integrate(state.q, -step);
      };
      expected.col(j) = (45 * odd(0.01) - 9 * odd(0.02) + odd(0.03)) / 0.6;
    }
    EXPECT_LE(distance(got, expected), kDifferences);
  });
}

/// One row of a table as a tensor: entry (i, j, k) at i + n j + n n k.
double entry(const MatrixXd& table, Eigen::Index state, Eigen::Index n, Eigen::Index i,
             Eigen::Index j, Eigen::Index k) {
  return table(state, i + n * (j + n * k));
}

/// lambda . d2 tau / d(first) d(second).
MatrixXd contract(const MatrixXd& table, Eigen::Index state, const VectorXd& lambda) {
  const Eigen::Index n = lambda.size();
  MatrixXd out = MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index i = 0; i < n; ++i) out(j, k) += lambda[i] * entry(table, state, n, i, j, k);
  return out;
}

TEST(TracedDerivatives, IteratedHessianIsPinocchios) {
  const OracleRobot robot{"hyq", Base::kFloating};
  const MatrixXd qq = oracle(robot, "d2tau_dqdq"), qv = oracle(robot, "d2tau_dqdv");
  const MatrixXd vv = oracle(robot, "d2tau_dvdv"), aq = oracle(robot, "d2tau_dadq");
  if (!std::filesystem::exists(oracle_urdf(robot)) || qq.size() == 0)
    GTEST_SKIP() << "no recorded results for " << robot.name;
  ModelOptions options;
  options.base = robot.base;
  options.order = JointOrder::kAlphabetical;
  options.snap = 0;
  Diagnostics diagnostics;
  const Model model = configure(read_urdf(oracle_urdf(robot), diagnostics), options, diagnostics);
  const DynamicTree tree = lower(model, lowerings("rnea")[1]);
  Problem p(tree);
  const SparseMatrix iterated = iterated_hessian(p.builder, p.sum, p.all());
  const MatrixXd q = oracle(robot, "qflat"), v = oracle(robot, "v"), a = oracle(robot, "a");
  const Eigen::Index n = tree.nv;
  Random random(7);
  double worst = 0;
  for (Eigen::Index s = 0; s < q.rows(); ++s) {
    const VectorXd lambda = random.vector(tree.nv, 1);
    const State state{q.row(s), v.row(s), a.row(s), {}};
    const MatrixXd H = evaluate_at(p.builder, iterated, state, lambda);
    const double errors[] = {distance(H.block(0, 0, n, n), contract(qq, s, lambda)),
                             distance(H.block(0, n, n, n), contract(qv, s, lambda)),
                             distance(H.block(n, n, n, n), contract(vv, s, lambda)),
                             distance(H.block(2 * n, 0, n, n), contract(aq, s, lambda))};
    for (const double error : errors) {
      EXPECT_LE(error, kPinocchio) << "state " << s;
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst", fmt::format("{:.1e}", worst));
}

}  // namespace
}  // namespace arboc::test

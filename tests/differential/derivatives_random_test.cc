// rnea_derivatives on random models: against inverse dynamics on numbers with a derivative, against
// the reference engine's by complex step, and the traced function against the generic one.
#include <gtest/gtest.h>

#include "functions/trace.h"
#include "passes/passes.h"
#include "program/program.h"
#include "reference/differentiate.h"
#include "support/dual.h"
#include "support/random_model.h"
#include "support/random_state.h"

#include "algorithms/rnea_derivatives.h"
#include "tree/lower.h"

namespace arboc::test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rounding; lowering enlarges second moments of far bodies, of which differences remain.
constexpr double kRounding = 1e-11;

constexpr LoweringOptions kLowerings[] = {{FrameChoice::kAxis, false},
                                          {FrameChoice::kDenavit, false},
                                          {FrameChoice::kAxis, true},
                                          {FrameChoice::kDenavit, true}};

struct Kind {
  const char* name;
  RandomModelOptions options;
};
const Kind kKinds[] = {
    {"fixed base, every joint", {9}},
    {"floating base, every joint", {9, Base::kFloating}},
    {"fixed base, single joints", {9, Base::kFixed, false, false}},
    {"revolute, no mimic", {7, Base::kFixed, false, false, false, false}},
    {"joints beyond URDF", {6, Base::kFixed, true, true, true, true, true, false, true}},
    {"massless leaves", {9, Base::kFloating, true, true, true, true, true, true}},
};

template <class Check>
void for_each_case(Check check) {
  for (const Kind& kind : kKinds)
    for (const std::uint64_t seed : seeds(20)) {
      SCOPED_TRACE(std::string(kind.name) + ", seed " + std::to_string(seed));
      const Model model = random_model(seed, kind.options);
      Random random(seed + 1000);
      const State state = random_state(model, random);
      if (state.v.size() > 0) check(model, state);
    }
}

double distance(const MatrixXd& a, const MatrixXd& b) {
  if (a.size() == 0) return 0;
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

std::vector<double> list(const VectorXd& x) { return {x.begin(), x.end()}; }

Values inputs(const State& s) { return {{"q", list(s.q)}, {"v", list(s.v)}, {"a", list(s.a)}}; }

Values generic(const Model& model, const LoweringOptions& lowering, const State& state) {
  return evaluate_generic({"rnea_derivatives"}, resolve(model), lowering, inputs(state));
}

MatrixXd square(const std::vector<double>& values, int n) {
  return Eigen::Map<const Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(values.data(), n, n);
}

/// q with the derivative of q (+) d with respect to d[k] at d = 0.
std::vector<Dual> moved(const DynamicTree& tree, const VectorXd& at, int k) {
  std::vector<Dual> q(at.begin(), at.end());
  for (const auto& body : tree.body) {
    const int d = k - body.v;
    if (d < 0 || d >= freedoms(body.motion)) continue;
    const int c = component(body.motion, d);
    Dual* own = q.data() + body.q;
    if (body.circle) {
      own[0].d = -own[1].x;
      own[1].d = own[0].x;
    } else if (freedoms(body.motion) == 1) {
      own->d = 1;
    } else if (body.motion == Motion::kPlanar) {
      const double cosine = std::cos(own[2].x), sine = std::sin(own[2].x);
      if (d == 0) own[0].d = cosine, own[1].d = sine;
      if (d == 1) own[0].d = -sine, own[1].d = cosine;
      if (d == 2) own[2].d = 1;
    } else if (c < 3) {
      const double quaternion[] = {own[3].x, own[4].x, own[5].x, own[6].x};
      const Vector3<double> e = column(rotation_of_quaternion(quaternion), c);
      for (int i = 0; i < 3; ++i) own[i].d = e[i];
    } else {
      Dual* quaternion = body.motion == Motion::kSpherical ? own : own + 3;
      const Vector3<double> u{quaternion[0].x, quaternion[1].x, quaternion[2].x};
      Vector3<double> e;
      e[c - 3] = 1;
      const Vector3<double> change = quaternion[3].x * e + cross(u, e);
      for (int i = 0; i < 3; ++i) quaternion[i].d = change[i] / 2;
      quaternion[3].d = -u[c - 3] / 2;
    }
  }
  return q;
}

VectorXd derivative(const DynamicTree& tree, const std::vector<Dual>& q, const std::vector<Dual>& v,
                    const std::vector<Dual>& a) {
  RneaWorkspace<Dual> work(tree);
  std::vector<Dual> tau(v.size());
  rnea(tree, work, q.data(), v.data(), a.data(), tau.data());
  VectorXd out(tree.nv);
  for (int i = 0; i < tree.nv; ++i) out[i] = tau[static_cast<size_t>(i)].d;
  return out;
}

TEST(Derivatives, AreThoseOfInverseDynamicsByAutomaticDifferentiation) {
  for_each_case([](const Model& model, const State& state) {
    for (const LoweringOptions& lowering : kLowerings) {
      const DynamicTree tree = lower(model, lowering);
      const Values got = generic(model, lowering, state);
      const std::vector<Dual> q(state.q.begin(), state.q.end()), v(state.v.begin(), state.v.end()),
          a(state.a.begin(), state.a.end());
      MatrixXd dq(tree.nv, tree.nv), dv(tree.nv, tree.nv), M(tree.nv, tree.nv);
      for (int k = 0; k < tree.nv; ++k) {
        std::vector<Dual> moving = v, accelerating = a;
        moving[static_cast<size_t>(k)].d = accelerating[static_cast<size_t>(k)].d = 1;
        dq.col(k) = derivative(tree, moved(tree, state.q, k), v, a);
        dv.col(k) = derivative(tree, q, moving, a);
        M.col(k) = derivative(tree, q, v, accelerating);
      }
      EXPECT_LT(distance(square(got.at("dtau_dq"), tree.nv), dq), kRounding);
      EXPECT_LT(distance(square(got.at("dtau_dv"), tree.nv), dv), kRounding);
      EXPECT_LT(distance(square(got.at("M"), tree.nv), M), kRounding);
    }
  });
}

TEST(Derivatives, AreThoseOfTheReferenceEngineByComplexStep) {
  for_each_case([](const Model& model, const State& state) {
    const Reference reference(model);
    const ComplexReference complex(model);
    const auto rnea = [](const auto& r, const auto& x) { return r.rnea(x.q, x.v, x.a); };
    const auto expected = [&](With with) {
      return differentiate(complex, rnea, {state.q, state.v, state.a, {}}, with);
    };
    const DynamicTree tree = lower(model, kLowerings[3]);
    const Values got = generic(model, kLowerings[3], state);
    EXPECT_LT(distance(square(got.at("dtau_dq"), tree.nv), expected(With::kQ)), kRounding);
    EXPECT_LT(distance(square(got.at("dtau_dv"), tree.nv), expected(With::kV)), kRounding);
    EXPECT_LT(distance(square(got.at("M"), tree.nv), reference.crba(state.q)), kRounding);
  });
}

/// The traced function's outputs, dense.
Values evaluate_traced(const Model& model, const LoweringOptions& lowering, const Values& in) {
  const Setup tree = resolve(model);
  const Signature s = signature({"rnea_derivatives"}, tree);
  const Traced traced = trace({"rnea_derivatives"}, tree, lowering);
  const auto raw = evaluate(run_passes(traced.graph), {in.at("q"), in.at("v"), in.at("a")});
  Values out;
  for (size_t k = 0; k < s.outputs.size(); ++k) {
    MatrixXd dense = MatrixXd::Zero(tree.nv, tree.nv);
    const Pattern& pattern = traced.patterns[k];
    EXPECT_EQ(pattern.row.size(), raw[k].size());
    for (size_t e = 0; e < pattern.row.size(); ++e) {
      dense(pattern.row[e], pattern.col[e]) = raw[k][e];
      if (s.outputs[k].symmetric) dense(pattern.col[e], pattern.row[e]) = raw[k][e];
    }
    dense.transposeInPlace();
    out[s.outputs[k].name] = {dense.data(), dense.data() + dense.size()};
  }
  return out;
}

TEST(Derivatives, TracedOnesAreTheGenericOnes) {
  for_each_case([](const Model& model, const State& state) {
    for (const LoweringOptions& lowering : lowerings("rnea_derivatives")) {
      const DynamicTree tree = lower(model, lowering);
      const Values got = evaluate_traced(model, lowering, inputs(state));
      const Values expected = generic(model, lowering, state);
      for (const auto& [name, values] : expected)
        EXPECT_LT(distance(square(got.at(name), tree.nv), square(values, tree.nv)), kRounding)
            << name;
    }
  });
}

TEST(Derivatives, WriteCoupledEntriesOnly) {
  for_each_case([](const Model& model, const State& state) {
    const DynamicTree tree = lower(model, kLowerings[0]);
    const auto n = static_cast<size_t>(tree.nv);
    std::vector<double> dq(n * n, -77), dv = dq, M = dq;
    RneaDerivativesWorkspace<double> work(tree);
    rnea_derivatives(tree, work, state.q.data(), state.v.data(), state.a.data(),
                     SquareMatrix<double>{dq.data(), tree.nv},
                     SquareMatrix<double>{dv.data(), tree.nv},
                     UpperTriangle<double>{M.data(), tree.nv});
    size_t pairs = 0;
    for (const auto& row : tree.coupled) pairs += row.size();
    const auto written = [](const std::vector<double>& values) {
      return values.size() - static_cast<size_t>(std::count(values.begin(), values.end(), -77));
    };
    EXPECT_EQ(written(dq), n + 2 * pairs);
    EXPECT_EQ(written(dv), n + 2 * pairs);
    EXPECT_EQ(written(M), n + pairs);
  });
}

}  // namespace
}  // namespace arboc::test

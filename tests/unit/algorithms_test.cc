// Every lowering gives the dynamics of the model as written, and the algorithms agree with one
// another.
#include <gtest/gtest.h>

#include "algorithms/aba.h"
#include "algorithms/fk.h"
#include "algorithms/gravity.h"
#include "algorithms/minv.h"
#include "tree/lower.h"
#include "tree_models.h"

namespace arboc::test {
namespace {

// Moving frames along their axes enlarges second moments by the square of the distance, up to 100
// times here, and M_jj is their difference again.
constexpr double kTolerance = 1e-11;

constexpr LoweringOptions kLowerings[] = {{FrameChoice::kAxis, false},
                                          {FrameChoice::kDenavit, false},
                                          {FrameChoice::kAxis, true},
                                          {FrameChoice::kDenavit, true}};

struct Kind {
  const char* name;
  RandomModelOptions options;
};
const Kind kKinds[] = {
    {"general", {}},
    {"aligned", {12, true, true, true, false, Base::kFixed}},
    {"floating", {14, false, true, true, true, Base::kFloating}},
    {"aligned floating", {14, true, true, true, true, Base::kFloating}},
    {"chain of single joints", {8, true, false, false, true, Base::kFixed}},
};

template <class Check>
void for_each_case(Check check) {
  for (const Kind& kind : kKinds)
    for (unsigned seed = 0; seed < 25; ++seed) {
      const Model model = random_model(seed, kind.options);
      const State state = random_state(model, seed + 1000);
      if (state.v.empty()) continue;
      for (const LoweringOptions& lowering : kLowerings) {
        SCOPED_TRACE(std::string(kind.name) + ", seed " + std::to_string(seed) +
                     (lowering.frames == FrameChoice::kDenavit ? ", denavit" : "") +
                     (lowering.regroup ? ", regrouped" : ""));
        check(model, state, lower(model, lowering));
      }
    }
}

double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

Eigen::VectorXd run_rnea(const DynamicTree& tree, const State& s) {
  RneaWorkspace<double> work(tree);
  Eigen::VectorXd tau(tree.nv);
  rnea(tree, work, s.q.data(), s.v.data(), s.a.data(), tau.data());
  return tau;
}

/// The dense symmetric matrix whose upper triangle `write` fills.
template <class Write>
Eigen::MatrixXd symmetric_result(const DynamicTree& tree, Write write) {
  std::vector<double> upper(static_cast<size_t>(tree.nv) * static_cast<size_t>(tree.nv));
  write(UpperTriangle<double>{upper.data(), tree.nv});
  Eigen::MatrixXd M(tree.nv, tree.nv);
  for (int j = 0; j < tree.nv; ++j)
    for (int i = 0; i <= j; ++i) M(i, j) = M(j, i) = upper[static_cast<size_t>(i * tree.nv + j)];
  return M;
}

Eigen::MatrixXd run_crba(const DynamicTree& tree, const State& s) {
  CrbaWorkspace<double> work(tree);
  return symmetric_result(tree, [&](UpperTriangle<double> M) { crba(tree, work, s.q.data(), M); });
}

TEST(Algorithms, InverseDynamicsAgreesWithSpatialVectorsOnTheModel) {
  for_each_case([](const Model& model, const State& state, const DynamicTree& tree) {
    EXPECT_LT(distance(run_rnea(tree, state), spatial_rnea(model, state)), kTolerance);
  });
}

TEST(Algorithms, InertiaAgreesWithColumnsOfInverseDynamicsOnTheModel) {
  for_each_case([](const Model& model, const State& state, const DynamicTree& tree) {
    EXPECT_LT(distance(run_crba(tree, state), spatial_inertia(model, state)), kTolerance);
  });
}

TEST(Algorithms, FramesAreWhereTheModelPutsThem) {
  for_each_case([](const Model& model, const State& state, const DynamicTree& tree) {
    const std::vector<Eigen::Isometry3d> expected = placements(model, state);
    std::vector<int> all(tree.frame.size());
    for (size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
    std::vector<double> out(12 * all.size());
    FkWorkspace<double> work(tree);
    fk(tree, work, state.q.data(), all, out.data());
    for (size_t k = 0; k < all.size(); ++k) {
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> R(out.data() + 12 * k);
      const Eigen::Map<const Eigen::Vector3d> p(out.data() + 12 * k + 9);
      EXPECT_LT(distance(R, expected[k].linear()), kTolerance) << tree.frame[k].name;
      EXPECT_LT(distance(p, expected[k].translation()), kTolerance) << tree.frame[k].name;
    }
  });
}

TEST(Algorithms, GravityAndNonlinearEffectsAreSpecialCasesOfInverseDynamics) {
  for_each_case([](const Model&, const State& state, const DynamicTree& tree) {
    State still = state;
    still.a.assign(state.a.size(), 0);
    Eigen::VectorXd tau(tree.nv);
    RneaWorkspace<double> work(tree);
    nle(tree, work, state.q.data(), state.v.data(), tau.data());
    EXPECT_LT(distance(tau, run_rnea(tree, still)), kTolerance);
    still.v = still.a;
    GravityWorkspace<double> at_rest(tree);
    gravity(tree, at_rest, state.q.data(), tau.data());
    EXPECT_LT(distance(tau, run_rnea(tree, still)), kTolerance);
  });
}

TEST(Algorithms, ForwardDynamicsInvertsInverseDynamics) {
  for_each_case([](const Model& model, const State& state, const DynamicTree& tree) {
    const Eigen::MatrixXd M = spatial_inertia(model, state);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(M);
    const double condition = spectrum.eigenvalues().maxCoeff() / spectrum.eigenvalues()(0);
    if (!(condition > 0 && condition < 1e6)) return;  // a massless link may hang free
    const Eigen::VectorXd tau = run_rnea(tree, state);
    Eigen::VectorXd qdd(tree.nv), pivots(tree.nv);
    AbaWorkspace<double> work(tree);
    aba(tree, work, state.q.data(), state.v.data(), tau.data(), qdd.data(), pivots.data());
    EXPECT_LT(distance(qdd, Eigen::Map<const Eigen::VectorXd>(state.a.data(), tree.nv)),
              1e-14 * condition + kTolerance);
    EXPECT_GT(pivots.minCoeff(), 0);

    MinvWorkspace<double> inverse(tree);
    const Eigen::MatrixXd Minv = symmetric_result(
        tree, [&](UpperTriangle<double> out) { minv(tree, inverse, state.q.data(), out); });
    EXPECT_LT((Minv * M - Eigen::MatrixXd::Identity(tree.nv, tree.nv)).cwiseAbs().maxCoeff(),
              1e-13 * condition + kTolerance);
  });
}

TEST(Algorithms, CrbaWritesCoupledEntriesOnly) {
  for_each_case([](const Model&, const State& state, const DynamicTree& tree) {
    std::vector<double> marked(static_cast<size_t>(tree.nv) * static_cast<size_t>(tree.nv), -77);
    CrbaWorkspace<double> work(tree);
    crba(tree, work, state.q.data(), UpperTriangle<double>{marked.data(), tree.nv});
    size_t written = 0, expected = 0;
    for (const double x : marked) written += x != -77;
    for (const auto& row : tree.coupled) expected += 1 + row.size();
    EXPECT_EQ(written, expected);
  });
}

TEST(Algorithms, PivotsDoNotDependOnTheLowering) {
  const Model model = random_model(3, kKinds[2].options);
  const State state = random_state(model, 5);
  const DynamicTree plain = lower(model, kLowerings[0]);
  const DynamicTree regrouped = lower(model, kLowerings[3]);
  Eigen::VectorXd qdd(plain.nv), a(plain.nv), b(plain.nv);
  AbaWorkspace<double> work_a(plain), work_b(regrouped);
  aba(plain, work_a, state.q.data(), state.v.data(), state.a.data(), qdd.data(), a.data());
  aba(regrouped, work_b, state.q.data(), state.v.data(), state.a.data(), qdd.data(), b.data());
  EXPECT_LT(distance(a, b), kTolerance);
}

}  // namespace
}  // namespace arboc::test

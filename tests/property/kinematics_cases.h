// Random models in random motion, for the tests of the kinematic algorithms.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "reference/reference.h"
#include "support/kinematics.h"
#include "support/random_model.h"
#include "support/random_state.h"
#include "tree/lower.h"

namespace arboc::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMatrix = Eigen::Matrix<double, -1, -1, Eigen::RowMajor>;

// Rounding, of numbers that are differences of ones up to 100 times larger.
constexpr double kRounding = 1e-11;
// Five-point differences with this step: its fourth power times fifth derivatives in the hundreds.
constexpr double kStep = 1e-3;
constexpr double kDifferences = 1e-7;

inline double distance(const MatrixXd& a, const MatrixXd& b) {
  if (a.size() == 0) return 0;
  return (a - b).cwiseAbs().maxCoeff() / (1 + b.cwiseAbs().maxCoeff());
}

inline std::vector<double> list(const VectorXd& x) { return {x.begin(), x.end()}; }

inline VectorXd vector_of(const std::vector<double>& x) {
  return Eigen::Map<const VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// Of the numbers from `first` on.
inline MatrixXd matrix_of(const std::vector<double>& x, int rows, int cols, int first = 0) {
  return Eigen::Map<const RowMatrix>(x.data() + first, rows, cols);
}

/// Derivative of f(t) at 0.
template <class F>
auto derivative(F&& f, double step = kStep) {
  const auto inner = (f(step) - f(-step)).eval();
  const auto outer = (f(2 * step) - f(-2 * step)).eval();
  return ((8 * inner - outer) / (12 * step)).eval();
}

struct KinematicCase {
  const Model& model;
  const Reference& reference;
  const State& state;
  const DynamicTree& tree;

  /// The state after the time t, at constant a.
  KinematicInputs<double> at(double t = 0) const {
    const VectorXd way = t * state.v + 0.5 * t * t * state.a;
    const VectorXd q = t == 0 ? state.q : reference.integrate(state.q, way);
    return {list(q), list(state.v + t * state.a), list(state.a), {}};
  }
  VectorXd frames(const std::string& name, const std::vector<int>& which, Axes axes,
                  double t = 0) const {
    return vector_of(run_frames(name, tree, at(t), which, axes));
  }
  std::vector<double> other(const std::string& name, double t = 0) const {
    return run_other(name, tree, at(t));
  }
  std::vector<int> all_frames() const {
    std::vector<int> all(tree.frame.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }
};

/// Calls check(KinematicCase) for many.
template <class Check>
void for_each_case(int models, Check check) {
  const std::pair<const char*, RandomModelOptions> kinds[] = {
      {"fixed base, every joint", {9}},
      {"joints beyond URDF", {6, Base::kFixed, true, true, true, true, true, false, true}},
      {"floating base, every joint", {9, Base::kFloating}},
      {"fixed base, single joints", {9, Base::kFixed, false, false}},
      {"floating base, no mimic", {7, Base::kFloating, false, true, true, false}}};
  for (const auto& [name, options] : kinds)
    for (const std::uint64_t seed : seeds(models)) {
      const Model model = random_model(seed, options);
      Random random(seed + 1000);
      const State state = random_state(model, random);
      if (state.v.size() == 0) continue;
      const Reference reference(model);
      for (const FrameChoice choice : {FrameChoice::kAxis, FrameChoice::kDenavit}) {
        SCOPED_TRACE(std::string(name) + ", ARBOC_SEED=" + std::to_string(seed) +
                     (choice == FrameChoice::kAxis ? ", axis" : ", denavit"));
        check(KinematicCase{model, reference, state, lower(model, {choice, false})});
        if (testing::Test::HasFailure()) return;
      }
    }
}

}  // namespace arboc::test

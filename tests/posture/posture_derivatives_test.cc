// All terms of posture problems, on all models: derivatives against differences.
#include <gtest/gtest.h>

#include "build.h"
#include "unit/nlp_support.h"

namespace arboc::test {
namespace {

using posture::Task;

/// Every kind of row and cost at once.
Task everything(const std::string& path) {
  Task task = posture::read_task(path);
  task.objective = {0.3, 1e-4, 0.5, 0.7, 20, 0.9, 1e-3};
  return task;
}

void expect_exact(const Task& task, unsigned seed) {
  const posture::Model& model = posture::model(task.model);
  const posture::Built built = posture::build(task, model, {nlp::Aspect::kAll, pairs(task)});
  nlp::Assembly& nlp = *built.nlp;
  const nlp::Scales &v = nlp.variables(), &r = nlp.rows();
  std::mt19937_64 random(seed);
  const auto n = static_cast<Eigen::Index>(v.size()), m = static_cast<Eigen::Index>(r.size());
  // At what counts as 1 of all variables, and multipliers of which each row feels the same.
  VectorXd x = random_vector(n, random), lambda = random_vector(m, random);
  for (Eigen::Index i = 0; i < n; ++i) x[i] *= v.scale[static_cast<std::size_t>(i)];
  for (Eigen::Index k = 0; k < m; ++k) lambda[k] /= r.scale[static_cast<std::size_t>(k)];
  const DerivativeErrors e = derivative_errors(nlp, x, lambda, 0.7);
  // Relative to the largest entry, whose six-point differences by steps of 1e-3 carry some 1e-13 /
  // 1e-3 of rounding, and kinks of normalised torques not in reach.
  EXPECT_LT(e.gradient, 1e-9) << task.name;
  EXPECT_LT(e.jacobian, 1e-9) << task.name;
  EXPECT_LT(e.hessian, 1e-9) << task.name;
}

const std::string kTasks = ARBOC_SOURCE_DIR "/apps/posture/tasks/";

TEST(PostureDerivatives, OfThePlaneModel) {
  expect_exact(everything(kTasks + "nine_dof_trial1_obj3.toml"), 1);
}

TEST(PostureDerivatives, OfARobotFromUrdf) {
  Task task = everything(kTasks + "humanoid_standing.toml");
  task.looks[0].at = nlp::Vector3(3, 0.5, 1);  // and a look at a point
  task.looks[0].within.reset();
  expect_exact(task, 2);
}

TEST(PostureDerivatives, OfTheHuman) {
  Task task = everything(kTasks + "santos_spheres.toml");
  const Task line = everything(kTasks + "santos_line.toml"),
             friction = everything(kTasks + "santos_friction.toml"),
             load = everything(kTasks + "santos_backpack.toml");
  task.contacts[0] = line.contacts[0];      // forces along own axes
  task.contacts[2] = friction.contacts[2];  // a cone
  task.contacts[1].point = {0.01, 0.02, 0.03};
  task.targets.push_back(line.targets[0]);
  task.loads = load.loads;
  expect_exact(task, 3);
}

}  // namespace
}  // namespace arboc::test

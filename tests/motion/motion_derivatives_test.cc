// Jacobian and Hessian of motion problems against differences.
#include "motion/motion_support.h"

namespace arboc::test {
namespace {

struct Problem {
  motion::Task task;
  motion::Ends ends;
  motion::Built built;
  VectorXd x;
};

Problem problem(motion::Task task) {
  const motion::Model& model = posture::model(task.model);
  posture::Result start, end;
  motion::Ends ends = motion::predict_ends(task, model, start, end);
  const motion::Motion guess = motion::first_guess(task, ends);
  motion::Built built = motion::build(model, {{&task, &ends, &guess}});
  const VectorXd x = vector_of(motion::variables_of(built, {guess}));
  return {std::move(task), std::move(ends), std::move(built), x};
}

/// Every part of the objective at once.
motion::Objective everything() {
  motion::Objective o;
  o.displacement = 1;
  o.torque = 1e-3;
  o.normalised = 1;
  o.maximum = 1;
  o.acceleration = 1e-2;
  o.jerk = 1e-3;
  return o;
}

TEST(MotionDerivatives, AgreeWithDifferencesEntryByEntry) {
  motion::Task t = motion_task("nine_dof_trial3_obj3");
  t.duration = 1;  // dynamics that count
  t.curves.control_points = 8;
  t.objective = everything();
  Problem p = problem(t);
  expect_exact_near(*p.built.nlp, p.x, 0.1);
}

/// Along random directions, as the human's matrices are too large to be compared dense.
void expect_derivatives_along_directions(Problem& p, int directions) {
  nlp::Assembly& nlp = *p.built.nlp;
  std::mt19937_64 random(2);
  const auto m = static_cast<Eigen::Index>(nlp.rows().size());
  const VectorXd x = p.x + 0.01 * random_vector(p.x.size(), random);
  const VectorXd lambda = random_vector(m, random);
  const auto values = [&](const VectorXd& at) -> VectorXd {
    nlp.move_to(at.data());
    VectorXd all(m + 1);
    all << nlp.objective(), vector_of(nlp.constraints());
    return all;
  };
  const auto slope = [&](const VectorXd& at) -> VectorXd {
    nlp.move_to(at.data());
    VectorXd g = 0.7 * vector_of(nlp.gradient());
    const std::vector<double>& J = nlp.jacobian();
    for (std::size_t k = 0; k < J.size(); ++k)
      g[nlp.jacobian_pattern().col[k]] += J[k] * lambda[nlp.jacobian_pattern().row[k]];
    return g;
  };
  for (int k = 0; k < directions; ++k) {
    const VectorXd d = random_vector(x.size(), random);
    const auto along = [&](const auto& f) {
      return difference([&](const VectorXd& s) -> VectorXd { return f(x + s[0] * d); },
                        VectorXd::Zero(1), 0, 1e-3);
    };
    const VectorXd dc = along(values), dg = along(slope);
    nlp.move_to(x.data());
    VectorXd Jd = VectorXd::Zero(m + 1), Hd = VectorXd::Zero(x.size());
    Jd[0] = vector_of(nlp.gradient()).dot(d);
    const std::vector<double> J = nlp.jacobian(), H = nlp.hessian(0.7, lambda.data());
    for (std::size_t e = 0; e < J.size(); ++e)
      Jd[1 + nlp.jacobian_pattern().row[e]] += J[e] * d[nlp.jacobian_pattern().col[e]];
    for (std::size_t e = 0; e < H.size(); ++e) {
      const int i = nlp.hessian_pattern().row[e], j = nlp.hessian_pattern().col[e];
      Hd[i] += H[e] * d[j];
      if (i != j) Hd[j] += H[e] * d[i];
    }
    EXPECT_LT((Jd - dc).cwiseAbs().maxCoeff(), 1e-8 * dc.cwiseAbs().maxCoeff());
    EXPECT_LT((Hd - dg).cwiseAbs().maxCoeff(), 1e-8 * dg.cwiseAbs().maxCoeff());
  }
}

TEST(MotionDerivatives, OfTheHumanAgreeAlongDirections) {
  motion::Task t = motion_task("santos_lean");
  t.objective = everything();
  t.start.posture.search.starts = 1;
  Problem p = problem(t);
  expect_derivatives_along_directions(p, 3);
}

/// The chain rule is the same whatever the number of threads.
TEST(MotionDerivatives, DoNotDependOnThreads) {
  motion::Task t = motion_task("santos_lean");
  t.start.posture.search.starts = 1;
  Problem p = problem(t);
  const std::vector<double> ones(p.built.nlp->rows().size(), 1);
  std::vector<double> H[2], J[2];
  for (int threads = 1; threads <= 2; ++threads) {
    const nlp::Robot& robot = posture::model("santos").robot;
    robot.dynamics->use_threads(threads);
    robot.placements->use_threads(threads);
    p.built.nlp->move_to(p.x.data());
    J[threads - 1] = p.built.nlp->jacobian();
    H[threads - 1] = p.built.nlp->hessian(1, ones.data());
  }
  EXPECT_EQ(J[0], J[1]);
  EXPECT_EQ(H[0], H[1]);
}

}  // namespace
}  // namespace arboc::test

// Tasks that are shipped, and what an independent engine says of a motion.
#pragma once
#include <gtest/gtest.h>
#include <motion/predict.h>

#include "frontend/read_model.h"
#include "reference/reference.h"
#include "unit/nlp_support.h"

namespace arboc::test {

inline motion::Task motion_task(const std::string& name) {
  return motion::read_task(ARBOC_SOURCE_DIR "/apps/motion/tasks/" + name + ".toml");
}
inline motion::Result solve_motion(const motion::Task& t) {
  return motion::predict(t, posture::model(t.model));
}

/// Reactions of a motion that is given, on its own bases, a convex problem.
inline motion::Result reactions_of(const motion::Task& t, const motion::Motion& given) {
  motion::Options options;
  options.from = {given};
  options.reactions_only = true;
  return motion::predict(t, posture::model(t.model), options);
}

/// The problem of reactions alone is that of both where the motion is the optimum: same reactions.
/// What is left of 1e-4 N is KKT error, of both solutions.
inline void expect_same_reactions(const motion::Task& t, const motion::Result& both) {
  const motion::Result given = reactions_of(t, *both.motion);
  EXPECT_EQ(given.status, nlp::Status::kOptimal) << given.reason;
  EXPECT_LT(given.stages[0].iterations, 15);
  EXPECT_LE(given.stages[0].kkt_error, 1e-9);
  EXPECT_EQ((given.motion->q.points() - both.motion->q.points()).cwiseAbs().maxCoeff(), 0);
  EXPECT_LT((given.samples.reactions - both.samples.reactions).cwiseAbs().maxCoeff(), 1e-4);
}

/// First and second derivatives of a problem at random numbers within `spread` of x; these.
inline VectorXd expect_exact_near(nlp::Nlp& nlp, VectorXd x, double spread) {
  std::mt19937_64 random(1);
  x += spread * random_vector(x.size(), random);
  const VectorXd lambda = random_vector(static_cast<Eigen::Index>(nlp.rows().size()), random);
  const DerivativeErrors e = derivative_errors(nlp, x, lambda, 0.7, 1e-3);
  EXPECT_LT(e.gradient, 1e-9);
  EXPECT_LT(e.jacobian, 1e-9);
  EXPECT_LT(e.hessian, 1e-8);
  return x;
}

inline void expect_moves(const motion::Task& t, const motion::Result& r) {
  EXPECT_EQ(r.status, nlp::Status::kOptimal) << t.name << ": " << r.reason;
  EXPECT_GE(r.audit.instants, 401);
  for (const motion::Stage& s : r.stages) {
    EXPECT_LE(s.kkt_error, 10 * t.search.kkt) << t.name << ", " << s.name;
    EXPECT_LE(s.violation, 1e-7) << t.name << ", " << s.name;
  }
  EXPECT_TRUE(r.audit.passes(t.tolerance)) << t.name;
  EXPECT_LE(r.audit.joint_excess.value, 1e-7) << t.name;
  EXPECT_LE(r.audit.friction_excess.value, 1e-5) << t.name;
}

}  // namespace arboc::test

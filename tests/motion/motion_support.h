// Tasks that are shipped, and what an independent engine says of a motion.
#pragma once
#include <gtest/gtest.h>
#include <motion/predict.h>

#include "frontend/read_model.h"
#include "reference/reference.h"

namespace arboc::test {

inline motion::Task motion_task(const std::string& name) {
  return motion::read_task(ARBOC_SOURCE_DIR "/apps/motion/tasks/" + name + ".toml");
}
inline motion::Result solve_motion(const motion::Task& t) {
  return motion::predict(t, posture::model(t.model));
}

inline void expect_moves(const motion::Task& t, const motion::Result& r) {
  EXPECT_EQ(r.status, nlp::Status::kOptimal) << t.name << ": " << r.reason;
  ASSERT_FALSE(r.stages.empty());
  for (const motion::Stage& s : r.stages) {
    EXPECT_LE(s.kkt_error, 10 * t.search.kkt) << t.name << ", " << s.name;
    EXPECT_LE(s.violation, 1e-7) << t.name << ", " << s.name;
  }
  EXPECT_TRUE(r.audit.passes(t.tolerance)) << t.name;
  EXPECT_LE(r.audit.joint_excess.value, 1e-7) << t.name;
  EXPECT_LE(r.audit.friction_excess.value, 1e-5) << t.name;
}

}  // namespace arboc::test

// Root mean squares of the differences of two motions.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "common/compare.h"
#include "support/run_program.h"

namespace arboc::test {
namespace {

using study::Columns;

Columns sines(int frames, double rate, double offset) {
  Columns c{{"t", "q.a", "q.b", "tau.a"}, study::Rows(frames, 4)};
  for (int k = 0; k < frames; ++k) {
    const double t = k / rate;
    c.values.row(k) << t, std::sin(t) + offset, 2 * t, 0;
  }
  return c;
}

TEST(Compare, OffsetsAndLines) {
  const auto d = study::compare(sines(201, 100, 0.25), sines(61, 30, 0), "q.");
  ASSERT_EQ(d.size(), 2U);
  // Linear interpolation of a sine between 30 frames a second: (1/30)^2 / 8.
  EXPECT_NEAR(d[0].rmse, 0.25, 2e-4);
  EXPECT_NEAR(d[1].rmse, 0, 1e-14);
  EXPECT_NEAR(study::compare(sines(201, 100, 0), sines(61, 30, 0), "q.", -0.5)[1].rmse, 1, 1e-12);
}

TEST(Compare, Complaints) {
  EXPECT_THROW(study::compare(sines(9, 1, 0), sines(9, 1, 0), "z"), std::invalid_argument);
  EXPECT_THROW(study::compare(sines(9, 1, 0), sines(9, 1, 0), "q.", 100), std::invalid_argument);
  EXPECT_THROW(study::compare(sines(9, 1, 0), sines(1, 1, 0), "q."), std::invalid_argument);
  const TempDir folder;
  const std::string path = std::string(folder.path()) + "/a.csv";
  std::ofstream(path) << "t,q.a\n0,1\n1,x\n";
  try {
    study::read_csv(path);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(std::string(e.what()), path + ":3: 'x' is not a number");
  }
  std::ofstream(path) << "t,q.a\n0\n";
  EXPECT_THROW(study::read_csv(path), std::invalid_argument);
  EXPECT_THROW(study::read_csv(path + "x"), std::invalid_argument);
}

TEST(Compare, Program) {
  const TempDir folder;
  const std::string one = std::string(folder.path()) + "/one.csv",
                    two = std::string(folder.path()) + "/two.csv";
  std::ofstream(one) << "t,q.a\n0,0\n1,1\n2,2\n";
  std::ofstream(two) << "t,q.a\n0,0\n2,4\n";
  const Outcome run = run_program({COMPARE_MOTIONS, one, two});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "column,rmse,largest,time\nq.a,1.29099445,2,2\n");
  EXPECT_EQ(run_program({COMPARE_MOTIONS, one, two + "x"}).status, 2);
  EXPECT_EQ(run_program({COMPARE_MOTIONS}).status, 1);
}

}  // namespace
}  // namespace arboc::test

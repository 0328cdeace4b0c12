// Recordings of other programs: written and read again, read as others write them, compared.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "common/recording.h"
#include "support/run_program.h"
#include "support/temp_dir.h"

namespace arboc::test {
namespace {

using study::Recording;

std::string written(const TempDir& folder, const std::string& name, const std::string& text) {
  const std::string path = std::string(folder.path()) + "/" + name;
  std::ofstream(path) << text;
  return path;
}

Recording sample() {
  Recording r{"test", {"knee", "pelvis_tx"}, Eigen::VectorXd::LinSpaced(5, 0, 1), {}, true};
  r.values.resize(5, 2);
  r.values.col(0) = Eigen::VectorXd::LinSpaced(5, 0, 90);
  r.values.col(1) = Eigen::VectorXd::LinSpaced(5, 1, 2);
  return r;
}

TEST(Recordings, OpenSimComesBackAsItWas) {
  const TempDir folder;
  const Recording r =
      study::read_recording(written(folder, "a.mot", study::opensim_text(sample())));
  EXPECT_EQ(r.columns, sample().columns);
  EXPECT_EQ(r.values, sample().values);
  EXPECT_TRUE(r.degrees);
  EXPECT_DOUBLE_EQ(r.times[1], 0.25);
}

TEST(Recordings, MarkersComeBackInMetres) {
  Recording r{"m", {"head x", "head y", "head z"}, Eigen::VectorXd::LinSpaced(3, 0, 1), {}, false};
  r.values = study::Rows::Random(3, 3);
  const TempDir folder;
  const Recording back = study::read_recording(written(folder, "a.trc", study::trc_text(r)));
  EXPECT_EQ(back.columns, r.columns);
  EXPECT_LT((back.values - r.values).cwiseAbs().maxCoeff(), 1e-12);
}

/// With the ends of lines and the empty cells that cameras leave.
TEST(Recordings, ReadsMarkersThatWereNotSeen) {
  const TempDir folder;
  const Recording r = study::read_recording(written(
      folder, "b.trc",
      "PathFileType\t4\t(X/Y/Z)\tb.trc\r\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\r\n"
      "100\t100\t2\t1\tmm\r\nFrame#\tTime\tTOE\t\t\r\n\t\tX1\tY1\tZ1\r\n\r\n"
      "1\t0.00\t\t\t5\r\n2\t0.01\t1000\t2\t3\r\n3\t0.02\t\t\t\r\n"));
  ASSERT_EQ(r.values.rows(), 3);
  EXPECT_TRUE(std::isnan(r.values(2, 0)) && std::isnan(r.values(2, 2)));
  EXPECT_TRUE(std::isnan(r.values(0, 0)));
  EXPECT_DOUBLE_EQ(r.values(1, 0), 1);
}

TEST(Recordings, SaysWhereAFileIsWrong) {
  const TempDir folder;
  const auto complaint = [&](const std::string& name, const std::string& text) -> std::string {
    try {
      study::read_recording(written(folder, name, text));
    } catch (const std::invalid_argument& e) {
      return std::string(e.what()).substr(std::string(folder.path()).size() + 1);
    }
    return "";
  };
  EXPECT_EQ(complaint("a.csv", "t,x\n0,1\n1,two\n"), "a.csv:3: 'two' is not a number");
  EXPECT_EQ(complaint("b.csv", "t,x\n0,1\n0,2\n"), "b.csv:3: time does not rise");
  EXPECT_EQ(complaint("c.csv", "t,x\n0\n"), "c.csv:2: fewer numbers than columns");
  EXPECT_EQ(complaint("d.xyz", ""), "d.xyz: is none of .mot, .sto, .trc, .csv");
}

TEST(Recordings, DifferencesAreThoseOfTheFormulas) {
  Recording a = sample(), b = sample();
  b.times = Eigen::VectorXd::LinSpaced(9, 0, 2);  // twice as long; half of it is common
  b.values = study::Rows::Zero(9, 2);
  b.columns = {"pelvis_tx", "elbow"};
  b.values.col(0) = (b.times.array() + 1 + 0.5).matrix();
  const std::vector<study::Difference> d = study::compare(a, b);
  ASSERT_EQ(d.size(), 1U);
  EXPECT_EQ(d[0].column, "pelvis_tx");
  EXPECT_EQ(d[0].instants, 5);
  EXPECT_NEAR(d[0].rmse, 0.5, 1e-12);
  EXPECT_NEAR(d[0].largest, 0.5, 1e-12);
  EXPECT_NEAR(d[0].correlation, 1, 1e-9);
  EXPECT_THROW(study::compare(a, b, "q."), std::invalid_argument);
  b.columns = {"x", "y"};
  EXPECT_THROW(study::compare(a, b), std::invalid_argument);
}

TEST(Recordings, Program) {
  const TempDir folder;
  const std::string one = written(folder, "one.csv", "t,q.a,v.a\n0,0,1\n1,1,1\n2,2,1\n");
  const std::string two = written(folder, "two.csv", "t,q.a,v.a\n0,0,1\n1,1.5,1\n2,4,1\n");
  const Outcome run =
      run_program({COMPARE_MOTIONS, one, two, "--prefix", "q.", "-o", folder.path()});
  EXPECT_EQ(run.status, 0) << run.err;
  std::ifstream table(std::string(folder.path()) + "/comparison.csv");
  const std::string text{std::istreambuf_iterator<char>(table), {}};
  EXPECT_EQ(text.substr(0, text.find("q.a,3,1.19") + 10),
            "column,instants,rmse,largest,time,correlation\nq.a,3,1.19");
  EXPECT_EQ(text.find("v.a"), std::string::npos);
  const Outcome later = run_program({COMPARE_MOTIONS, one, one, "--shift", "0.5"});
  EXPECT_NE(later.out.find("0.5"), std::string::npos) << later.out;
  EXPECT_EQ(run_program({COMPARE_MOTIONS, one, two + "x"}).status, 2);
  EXPECT_EQ(run_program({COMPARE_MOTIONS}).status, 1);
}

}  // namespace
}  // namespace arboc::test

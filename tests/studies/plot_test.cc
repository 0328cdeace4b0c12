// Plots and tables of numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/csv.h"
#include "common/plot.h"

namespace arboc::test {
namespace {

using Eigen::VectorXd;

TEST(Plot, TicksAreRoundNumbers) {
  EXPECT_EQ(study::ticks(0, 10, 6), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(study::ticks(-0.3, 0.31, 4), (std::vector<double>{-0.2, 0, 0.2}));
  EXPECT_EQ(study::ticks(1, 1, 4).size(), 1U);
  for (const double size : {1e-9, 0.37, 3.0, 7e8}) {
    const auto t = study::ticks(0.1 * size, size, 6);
    EXPECT_GE(t.size(), 2U) << size;
    EXPECT_LE(t.size(), 7U) << size;
  }
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(Plot, ThinningKeepsExtremes) {
  const VectorXd x = VectorXd::LinSpaced(200001, 0, 1);
  VectorXd y = VectorXd::Zero(x.size());
  y[77777] = 5;
  const std::string with = study::svg({"peak", "x", "y", {{"y", x, y}}});
  EXPECT_LT(with.size(), 60000U);
  // The axis runs to 5 and the curve reaches its highest point near the top of the paper.
  const auto path = with.substr(with.find(" d=\""));
  double highest = HUGE_VAL;
  for (auto at = path.find('L'); at < path.find("fill"); at = path.find('L', at + 1))
    highest = std::min(highest, std::stod(path.substr(path.find(' ', at))));
  EXPECT_LT(highest, 60);
}

TEST(Plot, LinesBreakWhereThereIsNoNumber) {
  VectorXd x = VectorXd::LinSpaced(7, 0, 6), y = x;
  y[3] = std::nan("");
  EXPECT_EQ(count(study::svg({"t", "x", "y", {{"a", x, y}}}), "M"), 2U);
  y << 1, 10, 100, 0, 1, 1, 1;
  study::Plot log{"t", "x", "y", {{"a", x, y}}};
  log.log_y = true;
  const std::string text = study::svg(log);
  EXPECT_EQ(count(text, "M"), 2U);
  EXPECT_EQ(count(text, "1e"), 3U);
  EXPECT_THROW(study::svg({"t", "x", "y", {{"a", x, VectorXd::Zero(3)}}}), std::invalid_argument);
}

TEST(Csv, ColumnsSideBySide) {
  study::Rows a(2, 1), b(2, 2);
  a << 0.1, 2;
  b << 1, 2, 3, 4;
  EXPECT_EQ(study::csv({"t", "x", "y"}, {a, b}), "t,x,y\n0.10000000000000001,1,2\n2,3,4\n");
  EXPECT_THROW(study::csv({"t", "x"}, {a, b}), std::invalid_argument);
  EXPECT_THROW(study::csv({"t", "u"}, {a, study::Rows::Zero(3, 1)}), std::invalid_argument);
  EXPECT_EQ(study::prefixed("tau.", {"a", "b"}), (std::vector<std::string>{"tau.a", "tau.b"}));
}

}  // namespace
}  // namespace arboc::test
